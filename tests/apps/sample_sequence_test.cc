// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// data/room, the sample sequence of the repository.

#include "tests/apps/command_process.h"
#include "tests/apps/sample_room.h"
#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "msc_vo/bundle_adjustment/local_bundle_adjustment.h"
#include "msc_vo/datasets/trajectory.h"
#include "msc_vo/text/files.h"

namespace msc_vo {
namespace {

class SampleSequenceTest : public TemporaryFolder {};

TEST_F(SampleSequenceTest, PassesTheCheck) {
  const CommandOutcome outcome = RunCommand({"check", kRoom});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, Names("0 errors", "0 warnings"));
}

TEST_F(SampleSequenceTest, IsTrackedInAllFrames) {
  const CommandOutcome outcome = RunCommand({"replay", kRoom, "--output", Path("out")});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const nlohmann::json summary = nlohmann::json::parse(ReadFile(Path("out/summary.json")));
  EXPECT_EQ(summary["frames"]["count"], 32);
  EXPECT_EQ(summary["frames"]["tracked"], 32);
  EXPECT_LT(summary["error"]["ape_rmse"].get<double>(), 0.002);
}

// The default options, with landmark noise and 2 + 1 steps per window. All solvers take the same
// steps up to rounding, which moves a pose by less than 1e-8 m: the normal equations have condition
// numbers of at most 1e8. A different decision of the mapper, such as a rejected observation, would
// move it by a good part of the error, 0.7 mm. The bound lies between.
TEST_F(SampleSequenceTest, HasTheSameTrajectoryWithEverySolver) {
  constexpr double kTolerance = 1e-6;  // metres, radians
  const auto replay = [this](const std::string& solver) {
    const CommandOutcome outcome = RunCommand(
        {"replay", kRoom, "--output", Path(solver), "--set", "mapping.window.solver=" + solver});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
    return ReadTrajectory(Path(solver) + "/trajectory.txt");
  };
  const std::vector<TimedPose> expected = replay("block-schur");
  ASSERT_EQ(expected.size(), 32u);
  for (const auto& [name, solver] :
       {std::pair("ceres", BundleAdjustmentSolver::kCeres),
        std::pair("ceres-suite-sparse", BundleAdjustmentSolver::kCeresSuiteSparse)}) {
    BundleAdjustmentOptions options;
    options.solver = solver;
    std::string error;
    if (!options.IsValid(&error)) continue;  // Ceres was built without this sparse library
    SCOPED_TRACE(name);
    const std::vector<TimedPose> found = replay(name);
    ASSERT_EQ(found.size(), expected.size());
    for (size_t i = 0; i < found.size(); ++i) {
      const Rigid3 &a = found[i].world_from_cam, &b = expected[i].world_from_cam;
      EXPECT_LT((a.translation() - b.translation()).norm(), kTolerance) << i;
      EXPECT_LT(a.rotation().angularDistance(b.rotation()), kTolerance) << i;
    }
  }
}

}  // namespace
}  // namespace msc_vo
