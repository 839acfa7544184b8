// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// What `msc_vo replay` and `msc_vo export` leave, and how they end, if a file cannot be written, if
// there is nothing to export, or if they are interrupted.

#include <csignal>
#include <filesystem>

#include "tests/apps/command_process.h"
#include "tests/apps/rendered_sequence.h"
#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "msc_vo/datasets/trajectory.h"
#include "msc_vo/text/files.h"

namespace msc_vo {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

class ReplayOutputTest : public TemporaryFolder {
 protected:
  void SetUp() override {
    TemporaryFolder::SetUp();
    RenderSequence(Path("room"), {"--frames", "12", "--width", "160"});
  }
  CommandOutcome Replay(const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"replay", Path("room"), "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return RunCommand(arguments);
  }
  // Makes a result that cannot be replaced.
  void Block(const std::string& result) { WriteText(result + "/file", ""); }
};

TEST_F(ReplayOutputTest, FolderThatCannotBeWrittenIsFoundBeforeTheRun) {
  // No user can write into it.
  const CommandOutcome outcome = RunCommand({"replay", Path("room"), "--output", "/proc"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.output, LineNames("error:", "/proc/"));
  EXPECT_THAT(outcome.output, Not(HasSubstr("12/12")));
  EXPECT_THAT(outcome.output, Not(HasSubstr("results so far")));
}

TEST_F(ReplayOutputTest, ExportsAreWrittenThoughTheReportIsNot) {
  Block("out/report.html");
  const CommandOutcome outcome =
      Replay({"--output", Path("out"), "--export", "tum=" + Path("poses.txt")});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.output, LineNames("report.html"));
  EXPECT_EQ(ReadTrajectory(Path("poses.txt")).size(), 12u);
  EXPECT_FALSE(HasEntry(Path("out/checkpoint")));
}

TEST_F(ReplayOutputTest, ExportsAreNotMadeOfIncompleteResults) {
  Block("out/lines.ply");
  const CommandOutcome outcome = Replay({"--output", Path("out"), "--checkpoint-interval", "0",
                                         "--export", "tum=" + Path("poses.txt")});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.output, Names("lines.ply", "msc_vo replay --resume " + Path("out")));
  EXPECT_FALSE(HasEntry(Path("poses.txt")));
  fs::remove_all(Path("out/lines.ply"));
  EXPECT_EQ(RunCommand({"replay", "--quiet", "--resume", Path("out")}).exit_code, 0);
  EXPECT_EQ(ReadTrajectory(Path("poses.txt")).size(), 12u);
}

TEST_F(ReplayOutputTest, FailedTrackingIsNotHiddenByAnExportWithoutPoses) {
  for (const std::string& image : ListFolder(Path("room/rgb"))) {
    WriteImage("room/rgb/" + fs::path(image).filename().string(), CV_8UC3, 0, 160, 120);
  }
  const CommandOutcome outcome =
      Replay({"--output", Path("out"), "--export", "tum=" + Path("poses.txt")});
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_THAT(outcome.output, LineNames("--export tum=", "msc_vo export"));
  EXPECT_FALSE(HasEntry(Path("poses.txt")));
}

TEST_F(ReplayOutputTest, CommandsCanBeCopiedIntoAShell) {
  Block("it's out/lines.ply");
  const CommandOutcome outcome =
      Replay({"--output", Path("it's out"), "--checkpoint-interval", "0"});
  const std::string quoted = "'" + Path("it'\\''s out") + "'";
  EXPECT_THAT(outcome.output, HasSubstr("--resume " + quoted));
  const nlohmann::json summary = nlohmann::json::parse(ReadFile(Path("it's out/summary.json")));
  EXPECT_THAT(summary.at("command_line").get<std::string>(), HasSubstr("--output " + quoted));
}

TEST_F(ReplayOutputTest, ReportHasTheNameOfTheSequence) {
  EXPECT_EQ(RunCommand({"replay", Path("room/."), "--quiet", "--output", Path("out")}).exit_code,
            0);
  EXPECT_THAT(ReadFile(Path("out/report.html")), HasSubstr("<title>room"));
}

#ifdef MSC_VO_HAS_FUSION
TEST_F(ReplayOutputTest, InterruptedFusionOfAnExportIsNoError) {
  ASSERT_EQ(Replay({"--output", Path("out")}).exit_code, 0);
  int exit_code = -SIGINT;
  // A signal that comes before the fusion begins ends the program.
  for (double microseconds = 1e5; exit_code == -SIGINT; microseconds *= 1.25) {
    CommandProcess process({"export", Path("out"), "ply", Path("cloud.ply"), "--voxel", "0.005"});
    usleep(static_cast<useconds_t>(microseconds));
    process.Signal(SIGINT);
    exit_code = process.Wait();
  }
  EXPECT_EQ(exit_code, 130);
  EXPECT_FALSE(HasEntry(Path("cloud.ply")));
}
#endif

}  // namespace
}  // namespace msc_vo
