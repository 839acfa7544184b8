// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/text/files.h"

#include <cerrno>
#include <filesystem>

#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>
#include <sys/stat.h>

#include "msc_vo/text/write_error.h"

namespace msc_vo {
namespace {

namespace fs = std::filesystem;

class FilesTest : public TemporaryFolder {
 protected:
  std::string MakePipe(const std::string& name) {
    EXPECT_EQ(mkfifo(Path(name).c_str(), 0600), 0);
    return Path(name);
  }
  // A sparse file, which takes no space on disk.
  std::string MakeSparse(const std::string& name, std::uintmax_t size) {
    WriteText(name, "");
    fs::resize_file(Path(name), size);
    return Path(name);
  }
};

TEST_F(FilesTest, ReadRefusesEndlessFiles) {
  EXPECT_THAT(MessageOf([&] { ReadFile(MakePipe("fifo")); }), Names(Path("fifo"), "pipe"));
  EXPECT_THAT(MessageOf([&] { ReadFile("/dev/zero"); }), Names("/dev/zero", "device"));
}

TEST_F(FilesTest, ReadRefusesTooLargeFiles) {
  EXPECT_THAT(MessageOf([&] { ReadFile(MakeSparse("t.txt", kMaxTextBytes + (2 << 20))); }),
              Names("t.txt", "258 MiB", "256 MiB"));
  EXPECT_EQ(ReadFile(MakeSparse("largest.txt", 4096), 4096).size(), 4096u);
}

TEST_F(FilesTest, ReadNamesBrokenLinks) {
  fs::create_symlink(Path("loop.txt"), Path("loop.txt"));
  EXPECT_THAT(MessageOf([&] { ReadFile(Path("loop.txt")); }),
              Names("loop.txt", "symbolic link", "itself"));
  fs::create_symlink(Path("missing"), Path("dangling.txt"));
  EXPECT_THAT(MessageOf([&] { ReadFile(Path("dangling.txt")); }),
              Names("dangling.txt", "symbolic link", "exist"));
  EXPECT_TRUE(HasEntry(Path("loop.txt")));
  EXPECT_TRUE(HasEntry(Path("dangling.txt")));
  EXPECT_FALSE(HasEntry(Path("missing")));
}

TEST_F(FilesTest, FindEntryPrefersTheExactName) {
  WriteText("RGB.txt", "");
  EXPECT_EQ(FindEntry(Folder(), "rgb.txt"), Path("RGB.txt"));
  WriteText("rgb.txt", "");
  EXPECT_EQ(FindEntry(Folder(), "rgb.txt"), Path("rgb.txt"));
  EXPECT_EQ(FirstEntry(Folder(), {"none", "Rgb.txt"}), Path("RGB.txt"));
  EXPECT_EQ(FindEntry(Path("none"), "rgb.txt"), "");
}

TEST_F(FilesTest, CheckWritableLeavesNoTrace) {
  CheckWritable(Path("new.txt"));
  EXPECT_FALSE(HasEntry(Path("new.txt")));
  EXPECT_FALSE(HasEntry(Path("new.txt.partial")));
  WriteText("old.txt", "old");
  CheckWritable(Path("old.txt"));
  EXPECT_EQ(ReadFile(Path("old.txt")), "old");
  EXPECT_THAT(MessageOf([&] { CheckWritable(Path("no/such/folder.txt")); }),
              Names("folder.txt", "written"));
  EXPECT_THAT(MessageOf([&] { CheckWritable(Folder()); }), Names(Folder(), "a folder"));
}

TEST_F(FilesTest, WriteReplacesLinkAndKeepsItsTarget) {
  for (const char* link : {"a.txt", "a.txt.partial"}) {
    WriteText("target.txt", "old");
    fs::create_symlink(Path("target.txt"), Path(link));
    WriteFile(Path("a.txt"), "new");
    EXPECT_EQ(ReadFile(Path("a.txt")), "new");
    EXPECT_EQ(ReadFile(Path("target.txt")), "old");
    fs::remove(Path("a.txt"));
  }
}

TEST_F(FilesTest, GrowingFileIsOnDiskAfterEachAppend) {
  WriteText("target.txt", "old");
  fs::create_symlink(Path("target.txt"), Path("growing.txt"));
  GrowingFile growing(Path("growing.txt"));
  growing.Append("one ");
  EXPECT_EQ(ReadFile(Path("growing.txt")), "one ");
  growing.Append("two");
  EXPECT_EQ(ReadFile(Path("growing.txt")), "one two");
  EXPECT_EQ(ReadFile(Path("target.txt")), "old");
}

TEST_F(FilesTest, WriteReplacesOnlyRegularFiles) {
  const std::string pipe = MakePipe("fifo");
  EXPECT_THAT(MessageOf([&] { WriteFile(pipe, "text"); }), Names(pipe, "written", "pipe"));
  EXPECT_THAT(MessageOf([&] { GrowingFile file(pipe); }), Names(pipe, "pipe"));
  EXPECT_THAT(MessageOf([&] { WriteFile(Folder(), "text"); }), Names(Folder(), "a folder"));
  EXPECT_TRUE(fs::is_fifo(pipe));
}

TEST_F(FilesTest, WriteErrorsNameTheCause) {
  EXPECT_THAT(MessageOf([&] { WriteFile(Path("no/folder.txt"), "text"); }),
              Names("folder.txt", "written", std::strerror(ENOENT)));
  for (const auto& [cause, lacks_space] :
       {std::pair(ENOSPC, true), {EDQUOT, true}, {EROFS, false}, {EFBIG, false}, {0, false}}) {
    EXPECT_EQ(WriteError("file", cause).LacksSpace(), lacks_space) << cause;
  }
}

// `make_room` can remove two files; the third attempt succeeds.
TEST(WriteWithRoom, MakesRoomOnlyForLackOfSpace) {
  int num_attempts = 0, num_files = 2;
  const MakeRoom make_room = [&](std::uintmax_t num_bytes) {
    EXPECT_EQ(num_bytes, 5u);
    return num_files-- > 0;
  };
  const auto write = [&](int cause, int num_failures) {
    num_attempts = 0;
    num_files = 2;
    WriteWithRoom(
        [&] {
          if (num_attempts++ < num_failures) throw WriteError("file", cause);
        },
        5, make_room);
  };
  write(ENOSPC, 2);
  EXPECT_EQ(num_attempts, 3);
  EXPECT_EQ(num_files, 0);
  EXPECT_THROW(write(ENOSPC, 3), WriteError);
  EXPECT_THROW(write(EROFS, 1), WriteError);
  EXPECT_EQ(num_files, 2);
}

TEST_F(FilesTest, TellsWhatWouldFitOntoTheDisk) {
  const std::uintmax_t available = fs::space(Folder()).available;
  EXPECT_TRUE(WouldFit(Folder(), 0, available / 2));
  EXPECT_FALSE(WouldFit(Folder(), 0, 2 * available + 1));
  EXPECT_TRUE(WouldFit(Folder(), 2 * available, 2 * available + 1));
}

}  // namespace
}  // namespace msc_vo
