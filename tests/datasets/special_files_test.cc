// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Files of a sequence that are not regular files or too large.

#include <filesystem>

#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>
#include <sys/stat.h>

#include "msc_vo/datasets/rgbd_decoder.h"
#include "msc_vo/datasets/sequence.h"
#include "msc_vo/datasets/sequence_calibration.h"
#include "msc_vo/datasets/trajectory.h"
#include "msc_vo/image_files/image_file.h"
#include "msc_vo/text/files.h"

namespace msc_vo {
namespace {

namespace fs = std::filesystem;

class SpecialFilesTest : public TemporaryFolder {
 protected:
  std::string MakePipe(const std::string& name) {
    EXPECT_EQ(mkfifo(Path(name).c_str(), 0600), 0);
    return Path(name);
  }
  std::string MakeLoop(const std::string& name) {
    fs::create_symlink(Path(name), Path(name));
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

TEST_F(SpecialFilesTest, ReadersRefuseThem) {
  const std::string pipe = MakePipe("fifo");
  EXPECT_THAT(MessageOf([&] { ReadTrajectory(pipe); }), Names(pipe, "pipe"));
  EXPECT_THAT(MessageOf([&] { ReadImageSize(pipe); }), Names(pipe, "pipe"));
  WriteText("i.png", "");
  fs::resize_file(Path("i.png"), kMaxImageBytes + 1);
  EXPECT_THAT(MessageOf([&] { ReadImageSize(Path("i.png")); }), Names("i.png", "MiB"));
  EXPECT_THAT(MessageOf([&] { OpenSequence(MakeLoop("loop")); }), Names("loop", "symbolic link"));
}

TEST_F(SpecialFilesTest, SequenceWithSpecialListNamesFile) {
  for (const char* name : {"rgb.txt", "camera.txt", "groundtruth.txt", "associations.txt"}) {
    MakeSequence();
    fs::remove(Path(name));
    const std::string path = MakeLoop(name);
    EXPECT_THAT(MessageOf([&] { Open(); }), Names(path, "symbolic link"));
    fs::remove(path);
    MakePipe(name);
    EXPECT_THAT(MessageOf([&] { Open(); }), Names(path, "pipe"));
    fs::remove(path);
    fs::create_directory(path);
    EXPECT_THAT(MessageOf([&] { Open(); }), Names(path, "folder"));
    fs::remove(path);
  }
}

TEST_F(SpecialFilesTest, SpecialImageNamesFileAndLine) {
  MakeSequence();
  fs::remove(Path("depth/2.png"));
  MakePipe("depth/2.png");
  const RgbdDecoder decoder = Open();
  EXPECT_THAT(MessageOf([&] { decoder.Decode(1); }),
              Names("2.png", Path("rgb.txt") + ":2", "depth.txt:2", "pipe"));
}

}  // namespace
}  // namespace msc_vo
