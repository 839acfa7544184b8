// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Names of map files, and files that cannot be written.

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <string>

#include "tests/map_file/random_map.h"
#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>
#include <sys/resource.h>
#include <unistd.h>

#include "msc_vo/map_file/map_images.h"
#include "msc_vo/map_file/map_reader.h"
#include "msc_vo/map_file/map_writer.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/write_error.h"

namespace msc_vo {
namespace {

namespace fs = std::filesystem;

// Acts as a user without privileges, to whom permissions apply.
class PlainUser {
 public:
  PlainUser() {
    if (geteuid() == 0 && seteuid(65534) != 0) is_plain_ = false;
  }
  ~PlainUser() {
    if (getuid() == 0 && seteuid(0) != 0) std::abort();
  }
  bool is_plain() const { return is_plain_; }

 private:
  bool is_plain_ = true;
};

class MapFileAccessTest : public TemporaryFolder {
 protected:
  // The message of the WriteError of a function; empty without one.
  static std::string WriteErrorOf(const std::function<void()>& function) {
    try {
      function();
    } catch (const WriteError& error) {
      return error.what();
    }
    return "";
  }

  void TearDown() override {
    if (!before_.empty()) fs::current_path(before_);
    TemporaryFolder::TearDown();
  }

  RandomMap random_;
  fs::path before_;  // working folder; empty: unchanged
};

TEST_F(MapFileAccessTest, TakesEveryNameForThatOfAFile) {
  before_ = fs::current_path();
  fs::current_path(Folder());
  for (const std::string name : {":memory:", "file:a.map", "file:b.map?mode=memory", "a?b=c"}) {
    SaveMap(name, AsContents(random_.Make(2)));
    EXPECT_TRUE(HasEntry(Path(name))) << name;
    EXPECT_NO_THROW(CheckMap(name));
  }
  EXPECT_FALSE(HasEntry(Path("a.map")));
}

TEST_F(MapFileAccessTest, RefusesNamesThatAreNone) {
  const std::string zero = Path("a.map") + std::string("\0b.map", 6);
  for (const std::string& name : {std::string(), zero}) {
    EXPECT_THAT(MessageOf([&] { SaveMap(name, AsContents(random_.Make(2))); }),
                testing::HasSubstr("name of the map file"));
    EXPECT_NE(MessageOf([&] { LoadMap(name); }), "");
    EXPECT_NE(MessageOf([&] { const MapImages images(name); }), "");
  }
  EXPECT_FALSE(HasEntry(Path("a.map")));
}

// A file that cannot be written, and a folder in which no journal can be.
TEST_F(MapFileAccessTest, RefusesAtOnceToWriteWhatIsReadOnly) {
  for (const bool is_file : {true, false}) {
    const std::string folder = Path(is_file ? "writable" : "read_only");
    fs::create_directory(folder);
    const std::string file = (fs::path(folder) / "home.map").string();
    SaveMap(file, AsContents(random_.Make(2)));
    fs::permissions(Folder(), fs::perms(0755));
    fs::permissions(folder, fs::perms(is_file ? 0777 : 0555));
    fs::permissions(file, fs::perms(is_file ? 0444 : 0666));
    const PlainUser user;
    if (!user.is_plain() || !FileProblem(file).empty()) GTEST_SKIP() << "root without setuid";
    EXPECT_THAT(WriteErrorOf([&] { MapWriter writer(file); }), Names(file, "cannot be written"));
    EXPECT_NO_THROW(LoadMap(file));
    if (is_file) continue;
    const std::string other = (fs::path(folder) / "new.map").string();
    EXPECT_THAT(WriteErrorOf([&] { MapWriter writer(other); }), Names(other, "cannot be written"));
  }
}

TEST_F(MapFileAccessTest, SaysThatAFileIsGone) {
  MapWriter writer(Path("a.map"));
  for (const int num_written : {0, 1}) {
    for (int i = 0; i < num_written; ++i) writer.Write(AsContents(random_.Make(2)));
    fs::rename(Path("a.map"), Path("b.map"));
    try {
      writer.Write(AsContents(random_.Make(3)));
      ADD_FAILURE() << num_written;
    } catch (const WriteError& error) {
      ADD_FAILURE() << error.what();
    } catch (const std::runtime_error& error) {
      EXPECT_THAT(error.what(), Names(Path("a.map"), "removed"));
    }
    fs::rename(Path("b.map"), Path("a.map"));
  }
}

TEST_F(MapFileAccessTest, SaysThatAFileMayNotGrow) {
  const std::string file = Path("home.map");
  SaveMap(file, AsContents(random_.Make(2)));
  const std::string before = ReadFile(file);
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit limit = {};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &limit), 0);
  const rlimit unlimited = limit;
  limit.rlim_cur = before.size() + 4096;
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &limit), 0);
  const std::string message = WriteErrorOf([&] { SaveMap(file, AsContents(random_.Make(60))); });
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &unlimited), 0);
  EXPECT_THAT(message, Names(file, "cannot be written", "File too large"));
  EXPECT_NO_THROW(CheckMap(file));
}

}  // namespace
}  // namespace msc_vo
