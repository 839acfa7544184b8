// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Local bundle adjustment on recorded windows.

#include <algorithm>

#include "tests/apps/command_process.h"
#include "tests/apps/rendered_sequence.h"
#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "msc_vo/datasets/trajectory.h"
#include "msc_vo/recording/window_file.h"
#include "msc_vo/synthetic/window/synthetic_window.h"
#include "msc_vo/text/files.h"

namespace msc_vo {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class SolveWindowCommandTest : public TemporaryFolder {
 protected:
  // A small solvable window.
  static WindowData SmallWindow() {
    SyntheticWindowOptions options;
    options.num_keyframes = 4;
    options.num_points = 50;
    options.num_lines = 10;
    return MakeSyntheticWindow(options).data;
  }
  void ExpectError(const std::vector<std::string>& arguments, const NamesMatcher& names,
                   int exit_code = 1) {
    const CommandOutcome outcome = RunCommand(arguments);
    EXPECT_EQ(outcome.exit_code, exit_code) << testing::PrintToString(arguments);
    EXPECT_THAT(outcome.output, AllOf(Names("error:"), names));
  }
  std::vector<std::string> FilesIn(const std::string& name) {
    std::vector<std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(Path(name))) {
      files.push_back(entry.path().string());
    }
    std::sort(files.begin(), files.end());
    return files;
  }
};

// "tx ty tz qx qy qz qw", as in a trajectory on disk.
std::string PoseText(const Rigid3& cam_from_world) {
  const std::string line = FormatTrajectory({{0.0, cam_from_world.Inverse()}});
  return line.substr(line.find(' '));
}

TEST_F(SolveWindowCommandTest, ReproducesTheMapper) {
  RenderSequence(Path("room"), {"--scene", "room", "--frames", "40", "--width", "160"});
  const CommandOutcome replay =
      RunCommand({"replay", "--no-planes", Path("room"), "--output", Path("out"), "--quiet",
                  "--dump-windows", Path("windows")});
  ASSERT_EQ(replay.exit_code, 0) << replay.output;
  const std::vector<std::string> files = FilesIn("windows");
  ASSERT_GE(files.size(), 2u);
  EXPECT_THAT(files.front(), testing::EndsWith("/window_000001.txt"));
  for (const std::string& file : files) {
    const CommandOutcome outcome =
        RunCommand({"solve-window", file, "--json", "--output", Path("solved.txt")});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
    const nlohmann::json json = nlohmann::json::parse(outcome.output);
    EXPECT_EQ(json["usable"], true);
    EXPECT_LT(json["final_cost"], json["initial_cost"]);
  }
  // The newest keyframe does not change after the last local bundle adjustment.
  const RecordedWindow before = ReadWindow(files.back());
  const RecordedWindow after = ReadWindow(Path("solved.txt"));
  const auto newest = std::max_element(after.data.keyframes.begin(), after.data.keyframes.end(),
                                       [](const auto& a, const auto& b) { return a.id < b.id; });
  const std::string keyframes = ReadFile(Path("out/keyframes.txt"));
  const Rigid3& pose_before =
      before.data.keyframes[newest - after.data.keyframes.begin()].cam_from_world;
  EXPECT_THAT(keyframes, HasSubstr(PoseText(newest->cam_from_world)));
  EXPECT_THAT(keyframes, testing::Not(HasSubstr(PoseText(pose_before))));
}

TEST_F(SolveWindowCommandTest, PrintsATableAndAppliesOptions) {
  WriteWindow(Path("window.txt"), BundleAdjustmentOptions(), SmallWindow());
  const CommandOutcome table = RunCommand({"solve-window", Path("window.txt")});
  EXPECT_EQ(table.exit_code, 0);
  EXPECT_THAT(table.output,
              Names("4 keyframes", "1 fixed", "solved", "point reprojection", "blocks", "ms"));

  WriteText("options.yaml", "mapping:\n  window:\n    second_iterations: 7\n");
  const CommandOutcome changed = RunCommand(
      {"solve-window", Path("window.txt"), "--json", "--output", Path("solved.txt"), "--config",
       Path("options.yaml"), "--set", "mapping.window.line_depth.enabled=false"});
  ASSERT_EQ(changed.exit_code, 0) << changed.output;
  EXPECT_EQ(nlohmann::json::parse(changed.output)["terms"]["line_depth"]["residual_blocks"], 0);
  const BundleAdjustmentOptions options = ReadWindow(Path("solved.txt")).options;
  EXPECT_EQ(options.second_iterations, 7);
  EXPECT_FALSE(options.line_depth.enabled);
}

TEST_F(SolveWindowCommandTest, ReportsErrorsWithTheFile) {
  WindowData data = SmallWindow();
  WriteWindow(Path("good.txt"), BundleAdjustmentOptions(), data);
  ExpectError({"solve-window", Path("none.txt")}, Names("none.txt", "exist"));
  ExpectError({"solve-window", Path("good.txt"), "--set", "mode=pl-vo"},
              Names("--set", "mode=pl-vo", "mapping.window"), 2);
  ExpectError({"solve-window", Path("good.txt"), "--set", "mapping.window.first_iterations=0"},
              Names("--set", "mapping.window.first_iterations", "1", "'0'"), 2);
  ExpectError({"solve-window", Path("good.txt"), "--output", Path("no/folder.txt")},
              Names("folder.txt", "written"));
  data.point_observations[3].point = 987;
  WriteWindow(Path("unknown.txt"), BundleAdjustmentOptions(), data);
  ExpectError({"solve-window", Path("unknown.txt")}, Names("unknown.txt", "point 987"));
  WriteText("other.txt", "1 2 3\n");
  ExpectError({"solve-window", Path("other.txt")}, Names("other.txt:1", "msc_vo_window 1"));
}

TEST_F(SolveWindowCommandTest, FailsOnUnsolvableWindows) {
  WindowData data = SmallWindow();
  data.point_observations[0].sigma = 1e-200;  // chi-square is not finite
  WriteWindow(Path("window.txt"), BundleAdjustmentOptions(), data);
  ExpectError({"solve-window", Path("window.txt"), "--output", Path("solved.txt")},
              Names("window.txt", "solver"));
  EXPECT_FALSE(std::filesystem::exists(Path("solved.txt")));
}

}  // namespace
}  // namespace msc_vo
