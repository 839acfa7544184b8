// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Whole runs on a small rendered sequence.

#include <algorithm>
#include <csignal>

#include "tests/apps/command_process.h"
#include "tests/apps/rendered_sequence.h"
#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "msc_vo/datasets/trajectory.h"
#include "msc_vo/results/online_results.h"
#include "msc_vo/results/ply_file.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/format_text.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class ReplayCommandTest : public TemporaryFolder {
 protected:
  void Synthesize(int num_frames) {
    RenderSequence(Path("room"),
                   {"--scene", "room", "--frames", std::to_string(num_frames), "--width", "160"});
  }
  CommandOutcome Replay(const std::string& output, std::vector<std::string> more = {}) {
    std::vector<std::string> arguments = {"replay", Path("room"), "--output", Path(output)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return RunCommand(arguments);
  }
  // Makes images [first, end) of the sequence black.
  void Blacken(const std::string& sequence, int first, int end) {
    const std::vector<TextLine> images = ReadTextLines(Path(sequence + "/rgb.txt"));
    for (int i = first; i < end; ++i) {
      WriteImage(sequence + "/" + images.at(i).fields.at(1), CV_8UC3, 0, 160, 120);
    }
  }
  nlohmann::json Summary(const std::string& output) {
    return nlohmann::json::parse(ReadFile(Path(output + "/summary.json")));
  }
  // Truncates a colour image to half its size. Returns the name of its file.
  std::string BreakColor(int i) {
    const std::filesystem::path path =
        Path("room/" + ReadTextLines(Path("room/rgb.txt")).at(i).fields[1]);
    std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
    return path.filename().string();
  }
  // Checks that the files of a run contain the same numbers of frames, landmarks and keyframes.
  void ExpectConsistentFiles(const std::string& output, size_t num_frames) {
    const nlohmann::json summary = Summary(output);
    EXPECT_EQ(summary["frames"]["count"], num_frames);
    const std::vector<TimedPose> truth = ReadTrajectory(Path("room/groundtruth.txt"));
    const std::vector<TimedPose> poses = ReadTrajectory(Path(output + "/trajectory.txt"));
    ASSERT_EQ(poses.size(), num_frames);
    for (size_t i = 0; i < num_frames; ++i) EXPECT_EQ(poses[i].timestamp, truth[i].timestamp);
    const std::vector<TimedPose> keyframes = ReadTrajectory(Path(output + "/keyframes.txt"));
    EXPECT_EQ(keyframes.size(), summary["map"]["keyframes"]);
    EXPECT_EQ(keyframes.front().timestamp, truth.front().timestamp);
    EXPECT_EQ(ReadTrajectory(Path(output + "/groundtruth.txt")).size(), truth.size());

    const std::vector<TextLine> rows = ReadTextLines(Path(output + "/frames.csv"));
    ASSERT_EQ(rows.size(), num_frames + 1);
    size_t num_keyframe_rows = 0;
    for (size_t i = 0; i < num_frames; ++i) {
      const std::vector<std::string>& fields = rows[i + 1].fields;
      EXPECT_EQ(fields.at(0), FormatText("%.6f", truth[i].timestamp));
      EXPECT_EQ(fields.at(1), "tracked");
      num_keyframe_rows += fields.at(2) == "1" ? 1 : 0;
    }
    EXPECT_EQ(num_keyframe_rows, keyframes.size());
    EXPECT_EQ(ReadLinesPly(Path(output + "/lines.ply")).size(), summary["map"]["lines"]);
    EXPECT_THAT(ReadFile(Path(output + "/map.ply")),
                HasSubstr("element vertex " + summary["map"]["points"].dump() + "\n"));
    EXPECT_GT(summary["map"]["points"], 100);
    EXPECT_GT(summary["map"]["lines"], 10);
    EXPECT_LT(summary["error"]["ape_rmse"], 0.01);
    const double millimetres = 1000.0 * summary["error"]["ape_rmse"].get<double>();
    EXPECT_THAT(ReadFile(Path(output + "/report.html")),
                AllOf(HasSubstr("<dt>APE RMSE</dt><dd class=\"value\">" +
                                FormatText("%.1f mm</dd>", millimetres)),
                      HasSubstr("map-line"), testing::EndsWith("</html>\n")));
  }
  // Waits until a running replay has written so many poses; at most a minute.
  void WaitForPoses(const std::string& output, int count) {
    const std::string path = Path(output + "/trajectory.txt");
    for (int i = 0; i < 60000; ++i) {
      if (HasEntry(path)) {
        const std::string text = ReadFile(path);
        if (std::count(text.begin(), text.end(), '\n') > count) return;  // one is a comment
      }
      usleep(1000);
    }
    FAIL() << path << " does not grow";
  }
  size_t NumPoses(const std::string& output) {
    return ReadTrajectory(Path(output + "/trajectory.txt")).size();
  }
};

TEST_F(ReplayCommandTest, WritesConsistentAndRepeatableResults) {
  Synthesize(20);
  const CommandOutcome outcome = Replay("a");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, Names("20/20", "APE RMSE", "100.0 %", "evo_ape"));
  ExpectConsistentFiles("a", 20);
  EXPECT_EQ(Summary("a")["outcome"], "complete");
  EXPECT_TRUE(Summary("a")["realtime"].is_null());

  EXPECT_EQ(Replay("b", {"--quiet"}).output, "");
  for (const char* name : {"trajectory.txt", "keyframes.txt", "map.ply", "lines.ply"}) {
    EXPECT_EQ(ReadFile(Path(std::string("a/") + name)), ReadFile(Path(std::string("b/") + name)));
  }
}

TEST_F(ReplayCommandTest, SaysWhatContradictsTheGroundTruth) {
  Synthesize(45);
  const std::string file = Path("room/groundtruth.txt");
  const std::vector<TimedPose> truth = ReadTrajectory(file);
  EXPECT_THAT(Replay("right").output, testing::Not(HasSubstr("ground truth: ")));
  EXPECT_TRUE(Summary("right")["error"]["warnings"].empty());
  std::vector<TimedPose> larger = truth;
  for (TimedPose& pose : larger) pose.world_from_cam.translation() *= 4.0;
  WriteTrajectory(file, larger);
  const NamesMatcher scale = LineNames("reference path", "4.0", "depth_scale");
  EXPECT_THAT(Replay("larger").output, scale);
  EXPECT_THAT(Summary("larger")["error"]["warnings"].dump(), scale);
  EXPECT_THAT(ReadFile(Path("larger/report.html")), scale);
  for (TimedPose& pose : larger) pose.world_from_cam.translation() /= 40.0;
  WriteTrajectory(file, larger);
  EXPECT_THAT(Replay("smaller").output, LineNames("estimated path", "10.0", "depth_scale"));
  std::vector<TimedPose> reordered = truth;
  for (TimedPose& pose : reordered) {
    const Eigen::Quaterniond q(pose.world_from_cam.rotation());
    pose.world_from_cam.rotation() = Eigen::Quaterniond(q.z(), q.w(), q.x(), q.y());
  }
  WriteTrajectory(file, reordered);
  EXPECT_THAT(Replay("reordered").output, LineNames("reference", "order qw qx qy qz"));
}

TEST_F(ReplayCommandTest, UsesTheAccelerometer) {
  Synthesize(90);
  ASSERT_EQ(Replay("plain", {"--quiet"}).exit_code, 0);
  const CommandOutcome outcome = Replay("gravity", {"--quiet", "--gravity"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_NE(ReadFile(Path("gravity/trajectory.txt")), ReadFile(Path("plain/trajectory.txt")));
  EXPECT_LT(Summary("gravity")["error"]["ape_rmse"], 0.02);

  std::filesystem::remove(Path("room/accelerometer.txt"));
  const CommandOutcome missing = Replay("missing", {"--gravity"});
  EXPECT_EQ(missing.exit_code, 1);
  EXPECT_THAT(missing.output, LineNames("error:", Path("room/accelerometer.txt"), "exist"));
}

TEST_F(ReplayCommandTest, RejectsInvalidAccelerometerAxes) {
  const CommandOutcome outcome = Replay("out", {"--gravity", "--accelerometer-axes=x,y,y"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.output, LineNames("--accelerometer-axes", "'x,y,y'", "right-handed"));
  EXPECT_EQ(Replay("out", {"--accelerometer-axes=x,y,z"}).exit_code, 2);  // without --gravity
}

TEST_F(ReplayCommandTest, FollowsTheTimeStampsInRealTime) {
  Synthesize(12);
  const CommandOutcome outcome = Replay("out", {"--realtime"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, LineNames("real time", "12", "dropped"));
  const nlohmann::json summary = Summary("out");
  EXPECT_EQ(summary["frames"]["count"], 12);
  EXPECT_EQ(summary["options"]["realtime"], true);
  const int num_dropped = summary["frames"]["dropped"];
  EXPECT_EQ(summary["realtime"]["pose_age_ms"]["count"], 12 - num_dropped);
  EXPECT_TRUE(summary["realtime"]["late_maps"].is_number_integer());
  EXPECT_GE(summary["wall_seconds"], 11 / 30.0);  // until the last image is due
  EXPECT_EQ(NumPoses("out"), 12u);
}

TEST_F(ReplayCommandTest, IgnoresTheNameOfTheFolder) {
  Synthesize(12);
  std::filesystem::create_directory_symlink(Path("room"), Path("fr1_room"));
  ASSERT_EQ(Replay("plain").exit_code, 0);
  const CommandOutcome outcome =
      RunCommand({"replay", Path("fr1_room"), "--output", Path("named")});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_EQ(ReadFile(Path("plain/trajectory.txt")), ReadFile(Path("named/trajectory.txt")));
  EXPECT_THAT(outcome.output, LineNames("global shutter", "self-calibrated"));
  EXPECT_THAT(Summary("named")["readout_time_origin"].get<std::string>(), Names("self-calibrated"));
}

TEST_F(ReplayCommandTest, ReportsTheSourceOfTheReadoutTime) {
  Synthesize(4);
  const std::string camera = ReadFile(Path("room/camera.txt"));
  WriteText("room/camera.txt", camera + "readout_time 0.02\n");
  CommandOutcome outcome = Replay("file");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, LineNames("rolling shutter", "20.0 ms"));
  EXPECT_EQ(Summary("file")["readout_time"], 0.02);
  EXPECT_EQ(Summary("file")["readout_time_origin"], Path("room/camera.txt"));
  outcome = Replay("option", {"--set", "mapping.readout_time=0"});
  EXPECT_THAT(outcome.output, LineNames("global shutter", "mapping.readout_time"));
  EXPECT_EQ(Summary("option")["readout_time_origin"], "mapping.readout_time");
}

TEST_F(ReplayCommandTest, StopsAfterMaxFrames) {
  Synthesize(6);
  EXPECT_EQ(Replay("out", {"--max-frames", "4", "--mode", "pl-vo"}).exit_code, 0);
  EXPECT_EQ(NumPoses("out"), 4u);
  EXPECT_EQ(Summary("out")["options"]["mode"], "pl-vo");
}

TEST_F(ReplayCommandTest, SkipsAndCountsUnreadableImages) {
  Synthesize(12);
  const std::string first = BreakColor(0), second = BreakColor(5);
  for (const char* pace : {"--realtime=false", "--realtime"}) {
    const CommandOutcome outcome = Replay("out", {pace});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
    const nlohmann::json summary = Summary("out");
    EXPECT_EQ(summary["outcome"], "complete");
    // In real time, a slow machine drops images, perhaps the second one.
    const int num_unreadable = summary["frames"]["unreadable"];
    const int num_dropped = summary["frames"]["dropped"];
    EXPECT_GE(num_unreadable, num_dropped == 0 ? 2 : 1);
    EXPECT_LE(num_unreadable, 2);
    const std::string count = std::to_string(num_unreadable);
    EXPECT_THAT(outcome.output,
                AllOf(LineNames("warning:", count, "12", first, ".txt:", "truncated"),
                      Names(count + " unreadable")));
    EXPECT_EQ(NumPoses("out"), 12u);
    EXPECT_THAT(summary["first_unreadable_image"].get<std::string>(), HasSubstr(first));
    EXPECT_THAT(ReadFile(Path("out/report.html")), HasSubstr(first));
    if (num_dropped == 0) {
      EXPECT_LT(summary["error"]["ape_max"], 0.02);  // of image 5 as well
    }
  }
  EXPECT_THAT(Replay("out", {"--quiet"}).output, LineNames("warning:", "2", "12"));
}

TEST_F(ReplayCommandTest, StopsAStrictRunAtAnUnreadableImage) {
  Synthesize(8);
  const std::string broken = BreakColor(5);
  const CommandOutcome outcome = Replay("out", {"--strict"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.output, Names("error:", broken, "truncated", "--resume"));
  EXPECT_EQ(NumPoses("out"), 5u);
  EXPECT_THAT(Summary("out")["outcome"].get<std::string>(), HasSubstr("truncated"));
}

TEST_F(ReplayCommandTest, FailsIfMoreThanHalfOfTheImagesAreUnreadable) {
  Synthesize(8);
  std::string first;
  for (const int i : {6, 5, 4, 3}) first = BreakColor(i);
  EXPECT_EQ(Replay("half").exit_code, 0);
  BreakColor(7);
  const CommandOutcome outcome = Replay("more");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.output, Names("error:", "half", "8", first, Path("more")));
  EXPECT_THAT(Summary("more")["outcome"].get<std::string>(), Names("half"));
}

TEST_F(ReplayCommandTest, FailsEarlyWithoutReadableImages) {
  Synthesize(2);
  std::string list;
  for (int i = 0; i < 100; ++i) {
    const std::string time = std::to_string(0.1 * i);
    list += time + " rgb/none" + std::to_string(i) + " " + time + " depth/none\n";
  }
  WriteText("room/associations.txt", list);
  const CommandOutcome outcome = Replay("out");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.output, LineNames("error:", "30", "none0"));
  EXPECT_FALSE(std::filesystem::exists(Path("out/trajectory.txt")));
}

TEST_F(ReplayCommandTest, WarnsAboutLongPausesInRealTime) {
  Synthesize(4);
  std::filesystem::remove(Path("room/associations.txt"));
  std::string lists[2];
  for (int k = 0; k < 2; ++k) {
    const std::vector<TextLine> lines =
        ReadTextLines(Path(k == 0 ? "room/rgb.txt" : "room/depth.txt"));
    const char* const stamps[] = {"1.0", "1.1", "1.2", "86401.2"};
    for (int i = 0; i < 4; ++i)
      lists[k] += std::string(stamps[i]) + " " + lines[i].fields[1] + "\n";
  }
  WriteText("room/rgb.txt", lists[0]);
  WriteText("room/depth.txt", lists[1]);
  CommandProcess replay({"replay", Path("room"), "--output", Path("out"), "--realtime"});
  EXPECT_TRUE(replay.WaitForOutput("86400.000 s")) << replay.output();
  replay.Signal(SIGTERM);
  replay.Signal(SIGTERM);
}

TEST_F(ReplayCommandTest, FailsWithCausesWithoutEstimatedPoses) {
  Synthesize(8);
  Blacken("room", 0, 8);
  const CommandOutcome outcome = Replay("out");
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_THAT(outcome.output, AllOf(LineNames("error:", "0", "8", "50 %", "8 black"),
                                    testing::Not(HasSubstr("APE RMSE"))));
  EXPECT_EQ(NumPoses("out"), 8u);  // all marked as not estimated
  for (const TimedPose& pose : ReadTrajectory(Path("out/trajectory.txt"))) {
    EXPECT_FALSE(pose.is_estimated);
  }
  EXPECT_TRUE(ReadTrajectory(Path("out/keyframes.txt")).empty());
  EXPECT_THAT(Summary("out")["outcome"].get<std::string>(), Names("0", "8"));
  EXPECT_EQ(Summary("out")["frames"]["loss_causes"]["uniform_image"], 8);
  EXPECT_FALSE(Summary("out")["error"]["usable"]);
  EXPECT_THAT(ReadFile(Path("out/report.html")),
              HasSubstr(Summary("out")["outcome"].get<std::string>()));
}

TEST_F(ReplayCommandTest, ExcludesUnestimatedPosesFromCoverage) {
  Synthesize(10);
  Blacken("room", 7, 10);
  const CommandOutcome outcome = Replay("out", {"--no-planes"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, Names("3 black", "70.0 %"));
  EXPECT_EQ(Summary("out")["error"]["coverage"], 0.7);
  EXPECT_EQ(Summary("out")["error"]["not_estimated"], 3);

  const std::vector<std::string> evaluate = {"evaluate", Path("room/groundtruth.txt"),
                                             Path("out/trajectory.txt"), "--json"};
  const auto num_matched = [](const std::vector<std::string>& command) {
    const std::string output = RunCommand(command).output;
    return nlohmann::json::parse(output.substr(output.find('{')))["matched"].get<int>();
  };
  EXPECT_EQ(num_matched(evaluate), 7);
  std::vector<std::string> all = evaluate;
  all.push_back("--all-poses");
  EXPECT_EQ(num_matched(all), 10);
}

TEST_F(ReplayCommandTest, WritesResultsOnInterrupt) {
  Synthesize(60);
  // Paced, so that the run is not over before the signal.
  CommandProcess replay({"replay", Path("room"), "--output", Path("out"), "--realtime", "--quiet"});
  WaitForPoses("out", 6);
  replay.Signal(SIGINT);
  EXPECT_EQ(replay.Wait(), 130) << replay.output();
  EXPECT_THAT(replay.output(), LineNames("interrupted", Path("out"), "resumed", "real time"));
  EXPECT_GE(NumPoses("out"), 6u);
  EXPECT_LT(NumPoses("out"), 60u);
  EXPECT_EQ(Summary("out")["outcome"], "interrupted");
  EXPECT_THAT(ReadFile(Path("out/report.html")), HasSubstr("interrupted"));
}

TEST_F(ReplayCommandTest, WritesResultsOnHangup) {
  Synthesize(60);
  // Paced, so that the run is not over before the signal.
  CommandProcess replay({"replay", Path("room"), "--output", Path("out"), "--realtime"});
  WaitForPoses("out", 6);
  replay.Signal(SIGHUP);
  replay.Signal(SIGHUP);  // from the system and from the shell
  EXPECT_EQ(replay.Wait(), 130) << replay.output();
  EXPECT_EQ(Summary("out")["outcome"], "interrupted");
}

TEST_F(ReplayCommandTest, LeavesFramesOfAKilledRun) {
  Synthesize(60);
  ASSERT_EQ(Replay("out", {"--max-frames", "4", "--quiet"}).exit_code, 0);
  // Paced, so that the run is not over before the signal.
  CommandProcess replay({"replay", Path("room"), "--output", Path("out"), "--realtime"});
  WaitForPoses("out", 6);
  replay.Signal(SIGKILL);
  ASSERT_EQ(replay.Wait(), -SIGKILL) << replay.output();
  EXPECT_THAT(ReadFile(Path("out/trajectory.txt")),
              testing::StartsWith(kUnfinishedTrajectoryComment));
  EXPECT_GE(NumPoses("out"), 6u);
  const std::string frames = ReadFile(Path("out/frames.csv"));
  EXPECT_GE(std::count(frames.begin(), frames.end(), '\n'), 7);
  EXPECT_FALSE(std::filesystem::exists(Path("out/summary.json")));  // of the previous run
}

TEST_F(ReplayCommandTest, FailsBeforeTheRunIfTheFolderCannotBeCreated) {
  Synthesize(2);
  WriteText("file", "");
  const CommandOutcome outcome = Replay("file/out");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.output, LineNames("error:", "created"));
  EXPECT_THAT(outcome.output, testing::Not(HasSubstr("1/2")));  // before the first image
}

}  // namespace
}  // namespace msc_vo
