// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// msc_vo export of a map in which several sessions have the name of the sequence.

#include <filesystem>
#include <string>
#include <vector>

#include "tests/apps/command_process.h"
#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>

#include "msc_vo/map_file/map_reader.h"
#include "msc_vo/text/files.h"

namespace msc_vo {
namespace {

// Sequences of the same name and with the same time stamps, a/seq and b/seq, and two.map with a
// session of each.
class RecordedSessionTest : public PreparedFolder {
 protected:
  void Prepare() override {
    Synthesize("a/seq", {"--width", "160"});
    Synthesize("b/seq", {"--width", "160", "--path", "2"});
    Replay("a", {"--map", Path("two.map")});
    Replay("b", {"--map", Path("two.map")});
  }
  static std::string Run(const std::vector<std::string>& arguments, int exit_code = 0) {
    const CommandOutcome outcome = RunCommand(arguments);
    EXPECT_EQ(outcome.exit_code, exit_code) << outcome.output;
    return outcome.output;
  }
  void Synthesize(const std::string& name, const std::vector<std::string>& more) const {
    std::filesystem::create_directories(std::filesystem::path(Path(name)).parent_path());
    std::vector<std::string> arguments = {"synthesize", Path(name), "--frames", "12"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    Run(arguments);
  }
  void Replay(const std::string& day, const std::vector<std::string>& more) const {
    std::vector<std::string> arguments = {"replay",   Path(day + "/seq"), "--quiet",
                                          "--output", Path("run_" + day), "--overwrite"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    Run(arguments);
  }
  std::string NameOfSession(const std::string& map, size_t i) const {
    return LoadMap(Path(map)).sessions.at(i).name;
  }
  // The list of images of a model of COLMAP.
  std::string Colmap(const std::string& map, const std::string& sequence,
                     const std::string& session = "") const {
    std::filesystem::remove_all(Path("model"));
    std::vector<std::string> arguments = {"export",      Path(map),    "colmap",
                                          Path("model"), "--sequence", Path(sequence)};
    if (!session.empty()) arguments.insert(arguments.end(), {"--session", session});
    Run(arguments);
    return ReadFile(Path("model/images.txt"));
  }
  std::string RefusedColmap(const std::string& map, const std::string& sequence) const {
    return Run({"export", Path(map), "colmap", Path("none"), "--sequence", Path(sequence)}, 1);
  }
};

TEST_F(RecordedSessionTest, IsRecognisedByTheImagesOfTheSequence) {
  const std::string a = Colmap("two.map", "a/seq"), b = Colmap("two.map", "b/seq");
  EXPECT_TRUE(a == Colmap("two.map", "a/seq", NameOfSession("two.map", 0)));
  EXPECT_TRUE(b == Colmap("two.map", "b/seq", NameOfSession("two.map", 1)));
  EXPECT_FALSE(a == b);
}

#ifdef MSC_VO_HAS_MCAP
TEST_F(RecordedSessionTest, IsRecognisedByTheImagesOfTheRun) {
  const auto mcap = [this](const std::string& session) {
    std::vector<std::string> arguments = {"export",         Path("run_a"), "mcap",
                                          Path("run.mcap"), "--map",       Path("two.map")};
    if (!session.empty()) arguments.insert(arguments.end(), {"--session", session});
    Run(arguments);
    return ReadFile(Path("run.mcap"));
  };
  const std::string found = mcap("");
  EXPECT_TRUE(found == mcap(NameOfSession("two.map", 0)));
  EXPECT_FALSE(found == mcap(NameOfSession("two.map", 1)));
}
#endif

TEST_F(RecordedSessionTest, IsAskedForWithoutImages) {
  Replay("a", {"--map", Path("blind.map"), "--no-map-images"});
  Replay("b", {"--map", Path("blind.map"), "--no-map-images", "--export",
               "colmap=" + Path("of_run")});  // whose results name its session
  const std::string a = NameOfSession("blind.map", 0), b = NameOfSession("blind.map", 1);
  EXPECT_THAT(RefusedColmap("blind.map", "a/seq"), LineNames("error:", a, b, "--session"));
  EXPECT_TRUE(ReadFile(Path("of_run/images.txt")) == Colmap("blind.map", "b/seq", b));
  EXPECT_FALSE(ReadFile(Path("of_run/images.txt")) == Colmap("blind.map", "a/seq", a));
  EXPECT_THAT(Run({"export", Path("blind.map"), "colmap", Path("none"), "--sequence", Path("a/seq"),
                   "--session", "seq, 1970"},
                  1),
              LineNames("error:", "seq, 1970", a, b));
  EXPECT_THAT(Run({"export", Path("blind.map"), "colmap", Path("none"), "--session", a}, 2),
              Names("--session", "no effect"));
}

TEST_F(RecordedSessionTest, IsNotThatOfOtherImages) {
  Synthesize("c/seq", {"--width", "160", "--path", "3"});
  EXPECT_THAT(RefusedColmap("two.map", "c/seq"),
              LineNames("error:", "two.map", Path("c/seq"), NameOfSession("two.map", 0),
                        NameOfSession("two.map", 1), "--session"));
  Replay("a", {"--map", Path("one.map")});
  EXPECT_THAT(RefusedColmap("one.map", "b/seq"), LineNames("error:", "one.map", Path("b/seq")));
  EXPECT_FALSE(HasEntry(Path("none")));
}

// Keyframes of all sessions are expressed in the camera of the last one.
TEST_F(RecordedSessionTest, HasTheImageSizeOfItsOwnCamera) {
  Synthesize("c/seq", {"--width", "200", "--path", "2"});
  Replay("c", {"--map", Path("two.map")});
  EXPECT_THAT(Colmap("two.map", "a/seq"), testing::HasSubstr(" rgb/"));
  EXPECT_THAT(ReadFile(Path("model/cameras.txt")), testing::HasSubstr(" 160 120 "));
  EXPECT_THAT(Colmap("two.map", "c/seq", NameOfSession("two.map", 2)), testing::HasSubstr(" rgb/"));
  EXPECT_THAT(ReadFile(Path("model/cameras.txt")), testing::HasSubstr(" 200 150 "));
  Replay("a", {"--map", Path("one.map")});
  Synthesize("d/seq", {"--width", "200"});
  EXPECT_THAT(RefusedColmap("one.map", "d/seq"),
              LineNames("error:", Path("d/seq"), "200", "150", "160", "120"));
}

// A map where the results of a run are expected.
TEST_F(RecordedSessionTest, CommandsSayThatAMapIsNoTrajectory) {
  const std::string map = Path("two.map"), sequence = Path("a/seq");
  for (const char* format : {"tum", "mcap", "nerfstudio"}) {
    EXPECT_THAT(Run({"export", map, format, Path("x")}, 1),
                LineNames("error:", map, "map export", format));
  }
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{"evaluate", map, sequence + "/groundtruth.txt"},
                                             {"evaluate", sequence + "/groundtruth.txt", map},
                                             {"fuse", sequence, map, "--output", Path("x.ply")}}) {
    EXPECT_THAT(Run(arguments, 1), LineNames("error:", map, "map export", "trajectory"));
  }
  for (const char* command : {"replay", "check"}) {
    EXPECT_THAT(Run({command, map}, 1), LineNames("error:", map, "--localize"));
  }
}

}  // namespace
}  // namespace msc_vo
