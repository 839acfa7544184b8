// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Whole runs on a small rendered sequence.

#include <csignal>

#include "tests/apps/command_process.h"
#include "tests/io/temporary_folder.h"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "msc_vo/io/text_file.h"
#include "msc_vo/io/trajectory.h"

namespace msc_vo {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class ReplayCommandTest : public TemporaryFolder {
 protected:
  void Synthesize(int num_frames) {
    const CommandOutcome outcome =
        RunCommand({"synthesize", Path("room"), "--scene", "room", "--frames",
                    std::to_string(num_frames), "--width", "160"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  }
  CommandOutcome Replay(const std::string& output, std::vector<std::string> more = {}) {
    std::vector<std::string> arguments = {"replay", Path("room"), "--output", Path(output)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return RunCommand(arguments);
  }
  // Images [first, end) of the sequence become black.
  void Blacken(const std::string& sequence, int first, int end) {
    const std::vector<TextLine> images = ReadTextLines(Path(sequence + "/rgb.txt"));
    for (int i = first; i < end; ++i) {
      WriteImage(sequence + "/" + images.at(i).fields.at(1), CV_8UC3, 0, 160, 120);
    }
  }
  nlohmann::json Summary(const std::string& output) {
    return nlohmann::json::parse(ReadFile(Path(output + "/summary.json")));
  }
  size_t NumPoses(const std::string& output) {
    return ReadTrajectory(Path(output + "/trajectory.txt")).size();
  }
};

TEST_F(ReplayCommandTest, WritesEverythingAndTheSameTrajectoryTwice) {
  Synthesize(20);
  const CommandOutcome outcome = Replay("a");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output,
              AllOf(HasSubstr("20/20"), HasSubstr("APE RMSE"),
                    HasSubstr("100.0 % of the ground-truth poses"), HasSubstr("evo_ape tum")));
  for (const char* name : {"trajectory.txt", "keyframes.txt", "groundtruth.txt", "frames.csv",
                           "map.ply", "lines.ply", "summary.json", "report.html"}) {
    EXPECT_GT(ReadFile(Path(std::string("a/") + name)).size(), 100u) << name;
  }
  EXPECT_EQ(NumPoses("a"), 20u);
  EXPECT_EQ(Summary("a")["outcome"], "complete");
  EXPECT_EQ(Summary("a")["frames"]["count"], 20);
  EXPECT_TRUE(Summary("a")["realtime"].is_null());

  EXPECT_EQ(Replay("b", {"--quiet"}).output, "");
  for (const char* name : {"trajectory.txt", "keyframes.txt", "map.ply", "lines.ply"}) {
    EXPECT_EQ(ReadFile(Path(std::string("a/") + name)), ReadFile(Path(std::string("b/") + name)));
  }
}

TEST_F(ReplayCommandTest, KeepsPaceWithTheTimeStampsInRealTime) {
  Synthesize(12);
  const CommandOutcome outcome = Replay("out", {"--realtime"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, AllOf(HasSubstr("real time"), HasSubstr("of 12 images dropped")));
  const nlohmann::json summary = Summary("out");
  EXPECT_EQ(summary["frames"]["count"], 12);
  EXPECT_EQ(summary["options"]["realtime"], true);
  const int num_dropped = summary["frames"]["dropped"];
  EXPECT_EQ(summary["realtime"]["pose_age_ms"]["count"], 12 - num_dropped);
  EXPECT_TRUE(summary["realtime"]["late_maps"].is_number_integer());
  EXPECT_GE(summary["wall_seconds"], 11 / 30.0);  // the last image does not appear earlier
  EXPECT_EQ(NumPoses("out"), 12u);
}

TEST_F(ReplayCommandTest, StopsAfterSoManyImages) {
  Synthesize(6);
  EXPECT_EQ(Replay("out", {"--max-frames", "4", "--mode", "pl-vo"}).exit_code, 0);
  EXPECT_EQ(NumPoses("out"), 4u);
  EXPECT_EQ(Summary("out")["options"]["mode"], "pl-vo");
}

TEST_F(ReplayCommandTest, ABadImageEndsTheRunButKeepsItsResults) {
  Synthesize(8);
  std::filesystem::path broken;
  int count = 0;
  for (const TextLine& line : ReadTextLines(Path("room/rgb.txt"))) {
    if (count++ == 5) broken = Path("room/" + line.fields[1]);
  }
  std::filesystem::resize_file(broken, std::filesystem::file_size(broken) / 2);
  const CommandOutcome outcome = Replay("out");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.output, AllOf(HasSubstr("msc_vo: error: "), HasSubstr(broken.filename()),
                                    HasSubstr("truncated"), HasSubstr("until then is in")));
  EXPECT_EQ(NumPoses("out"), 5u);
  EXPECT_THAT(Summary("out")["outcome"].get<std::string>(), HasSubstr("truncated"));
}

TEST_F(ReplayCommandTest, ARunWithoutAPoseFailsAndSaysWhy) {
  Synthesize(8);
  Blacken("room", 0, 8);
  const CommandOutcome outcome = Replay("out");
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_THAT(outcome.output,
              AllOf(HasSubstr("msc_vo: error: tracking failed: 0 of 8 images have an estimated "
                              "pose, at least 50 % are needed; the others: 8 black or uniform\n"),
                    testing::Not(HasSubstr("APE RMSE"))));
  EXPECT_EQ(NumPoses("out"), 8u);  // every one of them marked
  for (const TimedPose& pose : ReadTrajectory(Path("out/trajectory.txt"))) {
    EXPECT_FALSE(pose.is_estimated);
  }
  EXPECT_TRUE(ReadTrajectory(Path("out/keyframes.txt")).empty());
  EXPECT_THAT(Summary("out")["outcome"].get<std::string>(), HasSubstr("tracking failed"));
  EXPECT_EQ(Summary("out")["frames"]["loss_causes"]["uniform_image"], 8);
  EXPECT_FALSE(Summary("out")["error"]["usable"]);
  EXPECT_THAT(ReadFile(Path("out/report.html")), HasSubstr("tracking failed"));
}

TEST_F(ReplayCommandTest, PosesThatAreNotEstimatedAreNoCoverage) {
  Synthesize(10);
  Blacken("room", 7, 10);
  const CommandOutcome outcome = Replay("out");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, AllOf(HasSubstr("images without a pose: 3 black or uniform"),
                                    HasSubstr("70.0 % of the ground-truth poses")));
  EXPECT_EQ(Summary("out")["error"]["coverage"], 0.7);
  EXPECT_EQ(Summary("out")["error"]["not_estimated"], 3);

  const std::vector<std::string> evaluate = {"evaluate", Path("room/groundtruth.txt"),
                                             Path("out/trajectory.txt"), "--json"};
  EXPECT_EQ(nlohmann::json::parse(RunCommand(evaluate).output)["matched"], 7);
  std::vector<std::string> all = evaluate;
  all.push_back("--all-poses");
  EXPECT_EQ(nlohmann::json::parse(RunCommand(all).output)["matched"], 10);
}

TEST_F(ReplayCommandTest, CtrlCWritesWhatWasComputed) {
  Synthesize(60);
  CommandProcess replay({"replay", Path("room"), "--output", Path("out")});
  ASSERT_TRUE(replay.WaitForOutput("6/60")) << replay.output();
  replay.Signal(SIGINT);
  EXPECT_EQ(replay.Wait(), 130) << replay.output();
  EXPECT_GE(NumPoses("out"), 6u);
  EXPECT_LT(NumPoses("out"), 60u);
  EXPECT_EQ(Summary("out")["outcome"], "interrupted");
  EXPECT_GT(ReadFile(Path("out/report.html")).size(), 100u);
}

TEST_F(ReplayCommandTest, AFolderThatCannotBeMadeIsAnError) {
  Synthesize(2);
  WriteText("file", "");
  const CommandOutcome outcome = Replay("file/out");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.output, HasSubstr("cannot be made"));
  EXPECT_THAT(outcome.output, testing::Not(HasSubstr("1/2")));  // before the work
}

}  // namespace
}  // namespace msc_vo
