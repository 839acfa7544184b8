// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/text/files.h"

#include <filesystem>

#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>
#include <sys/stat.h>

#include "msc_vo/config/options_file.h"
#include "msc_vo/datasets/image_folder.h"
#include "msc_vo/datasets/sequence.h"
#include "msc_vo/datasets/sequence_check.h"
#include "msc_vo/datasets/trajectory.h"

namespace msc_vo {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

class FilesTest : public TemporaryFolder {
 protected:
  std::string MakePipe(const std::string& name) {
    EXPECT_EQ(mkfifo(Path(name).c_str(), 0600), 0);
    return Path(name);
  }
  std::string MakeLoop(const std::string& name) {
    fs::create_symlink(Path(name), Path(name));
    return Path(name);
  }
  // A file that claims so many bytes and takes no space.
  std::string MakeSparse(const std::string& name, std::uintmax_t size) {
    WriteText(name, "");
    fs::resize_file(Path(name), size);
    return Path(name);
  }
  void MakeSequence() {
    WriteText("rgb.txt", "1.0 rgb/1.png\n1.1 rgb/2.png\n");
    WriteText("depth.txt", "1.0 depth/1.png\n1.1 depth/2.png\n");
    WriteText("camera.txt", "10 10 3.5 2.5 8 6 5000\n");
    for (const char* name : {"1.png", "2.png"}) {
      WriteColor(std::string("rgb/") + name);
      WriteDepth(std::string("depth/") + name);
    }
  }
  RgbdDecoder Open() {
    SequenceIndex index = OpenSequence(Folder());
    Calibration calibration = ResolveCalibration({}, "", &index);
    return {std::move(index), std::move(calibration)};
  }
};

// Every reader of text goes through ReadFile; one of each kind stands for all.
TEST_F(FilesTest, WhatMayHaveNoEndIsNotRead) {
  Configuration configuration;
  for (const std::string& path : {MakePipe("pipe"), std::string("/dev/zero")}) {
    EXPECT_THAT(MessageOf([&] { ReadTrajectory(path); }), HasSubstr(path + ": is a "));
    EXPECT_THAT(MessageOf([&] { ReadConfiguration(path, &configuration); }), HasSubstr(path));
    EXPECT_THAT(MessageOf([&] { ReadImageSize(path); }), HasSubstr("may have no end"));
  }
}

TEST_F(FilesTest, TooLargeFilesAreNotRead) {
  Configuration configuration;
  EXPECT_THAT(MessageOf([&] { ReadTrajectory(MakeSparse("t.txt", kMaxTextBytes + (2 << 20))); }),
              HasSubstr("t.txt: has 258 MiB, more than the 256 MiB"));
  EXPECT_THAT(MessageOf([&] {
                ReadConfiguration(MakeSparse("c.yaml", kMaxOptionsBytes + 1), &configuration);
              }),
              HasSubstr("c.yaml: has "));
  EXPECT_THAT(MessageOf([&] { ReadImageSize(MakeSparse("i.png", kMaxImageBytes + 1)); }),
              HasSubstr("i.png: has "));
  EXPECT_EQ(ReadFile(MakeSparse("most.txt", 4096), 4096).size(), 4096u);
}

TEST_F(FilesTest, LinksThatLeadNowhereAreNamed) {
  EXPECT_THAT(MessageOf([&] { ReadTrajectory(MakeLoop("loop.txt")); }),
              HasSubstr("loop.txt: is a symbolic link that leads back to itself"));
  fs::create_symlink(Path("gone"), Path("dangling.txt"));
  EXPECT_THAT(MessageOf([&] { ReadTrajectory(Path("dangling.txt")); }),
              HasSubstr("is a symbolic link to a file that does not exist"));
  EXPECT_THAT(MessageOf([&] { OpenSequence(MakeLoop("loop")); }),
              HasSubstr("loop: is a symbolic link that leads back to itself; "));
  EXPECT_TRUE(HasEntry(Path("loop")));
  EXPECT_FALSE(HasEntry(Path("gone")));
}

TEST_F(FilesTest, ASequenceWithAFileOfTheWrongKindIsRefusedByItsName) {
  for (const char* name : {"rgb.txt", "camera.txt", "groundtruth.txt", "associations.txt"}) {
    MakeSequence();
    fs::remove(Path(name));
    const std::string path = MakeLoop(name);
    EXPECT_THAT(MessageOf([&] { Open(); }), HasSubstr(path + ": is a symbolic link that"));
    fs::remove(path);
    MakePipe(name);
    EXPECT_THAT(MessageOf([&] { Open(); }), HasSubstr(path + ": is a pipe"));
    fs::remove(path);
    fs::create_directory(path);
    EXPECT_THAT(MessageOf([&] { Open(); }), HasSubstr(path + ": is a folder"));
    fs::remove(path);
  }
}

TEST_F(FilesTest, AnImageOfTheWrongKindIsRefusedWithTheLineThatNamesIt) {
  MakeSequence();
  fs::remove(Path("depth/2.png"));
  MakePipe("depth/2.png");
  const RgbdDecoder decoder = Open();
  EXPECT_THAT(MessageOf([&] { decoder.Decode(1); }),
              AllOf(HasSubstr("2.png (named in " + Path("rgb.txt") + ":2 and "),
                    HasSubstr("depth.txt:2): is a pipe")));
  const std::vector<Finding> findings = CheckSequence(decoder, SequenceCheckOptions());
  EXPECT_THAT(findings,
              testing::Contains(testing::Field(&Finding::text, HasSubstr("2.png is a pipe"))));
}

TEST_F(FilesTest, WritingReplacesALinkAndNotItsTarget) {
  for (const char* link : {"a.txt", "a.txt.partial"}) {
    WriteText("target.txt", "old");
    fs::create_symlink(Path("target.txt"), Path(link));
    WriteFile(Path("a.txt"), "new");
    EXPECT_EQ(ReadFile(Path("a.txt")), "new");
    EXPECT_EQ(ReadFile(Path("target.txt")), "old");
    fs::remove(Path("a.txt"));
  }
  fs::create_symlink(Path("target.txt"), Path("growing.txt"));
  GrowingFile growing(Path("growing.txt"));
  growing.Append("one ");
  EXPECT_EQ(ReadFile(Path("growing.txt")), "one ");  // on disk at once
  growing.Append("two");
  EXPECT_EQ(ReadFile(Path("growing.txt")), "one two");
  EXPECT_EQ(ReadFile(Path("target.txt")), "old");
}

TEST_F(FilesTest, OnlyRegularFilesAreReplaced) {
  const std::string pipe = MakePipe("pipe");
  EXPECT_THAT(MessageOf([&] { WriteFile(pipe, "text"); }),
              HasSubstr("pipe: cannot be written: is a pipe"));
  EXPECT_THAT(MessageOf([&] { GrowingFile file(pipe); }), HasSubstr("is a pipe"));
  EXPECT_THAT(MessageOf([&] { WriteFile(Folder(), "text"); }), HasSubstr("is a folder"));
  EXPECT_TRUE(fs::is_fifo(pipe));
}

}  // namespace
}  // namespace msc_vo
