// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Compares EvaluateTrajectory with the reference tool ../shared/tools/ape.py on the same
// trajectories.

#include <filesystem>
#include <fstream>
#include <iomanip>
#include <string>

#include "tests/evaluation/curved_path.h"
#include "tests/evaluation/python_process.h"
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "msc_vo/evaluation/trajectory_error.h"
#include "msc_vo/geometry/angles.h"

namespace msc_vo {
namespace {

namespace fs = std::filesystem;

constexpr double kToolTolerance = 1e-6;

class ReferenceToolTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists(MSC_VO_REFERENCE_TOOL)) GTEST_SKIP() << "../shared/tools/ape.py does not exist";
    python_ = PythonWithNumpy();
    if (python_.empty()) GTEST_SKIP() << "python3 with numpy is not installed";
    folder_ = fs::path(testing::TempDir()) / ("reference_tool_" + std::to_string(getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override {
    if (!folder_.empty()) fs::remove_all(folder_);
  }

  void ExpectSameErrors(const std::vector<TimedPose>& truth,
                        const std::vector<TimedPose>& estimate) {
    WriteExactly(folder_ / "truth.txt", truth);
    WriteExactly(folder_ / "estimate.txt", estimate);
    const std::string output = OutputOf(python_ + " '" MSC_VO_REFERENCE_TOOL "' --json '" +
                                        (folder_ / "truth.txt").string() + "' '" +
                                        (folder_ / "estimate.txt").string() + "'");
    ASSERT_FALSE(output.empty());
    const nlohmann::json tool = nlohmann::json::parse(output);
    const TrajectoryError ours = EvaluateTrajectory(truth, estimate);
    ASSERT_TRUE(ours.usable);
    EXPECT_NEAR(ours.ape.rmse, tool["ape_rmse"], kToolTolerance);
    EXPECT_NEAR(ours.ape.mean, tool["ape_mean"], kToolTolerance);
    EXPECT_NEAR(ours.ape.median, tool["ape_median"], kToolTolerance);
    EXPECT_NEAR(ours.ape.max, tool["ape_max"], kToolTolerance);
    EXPECT_NEAR(RadiansToDegrees(ours.ape_rotation.rmse), tool["ape_rot_deg"], kToolTolerance);
    EXPECT_NEAR(ours.rpe_per_second.translation.rmse, tool["rpe_1s"], kToolTolerance);
    EXPECT_NEAR(RadiansToDegrees(ours.rpe_per_second.rotation.rmse), tool["rpe_1s_rot_deg"],
                kToolTolerance);
    EXPECT_EQ(ours.rpe_per_second.translation.count, tool["rpe_pairs"]);
    EXPECT_EQ(ours.num_matched, tool["matched"]);
    EXPECT_EQ(ours.num_reference_in_range, tool["gt_in_range"]);
    EXPECT_NEAR(ours.coverage, tool["coverage"], kToolTolerance);
    EXPECT_NEAR(ours.coverage_in_range, tool["coverage_in_range"], kToolTolerance);
    EXPECT_NEAR(ours.path_length, tool["path_len"], kToolTolerance);
  }

  std::string python_;
  fs::path folder_;
};

TEST_F(ReferenceToolTest, AgreesForIdenticalStamps) {
  const std::vector<TimedPose> truth = CurvedPath(150, 30.0);
  ExpectSameErrors(truth, Disturbed(truth, 0.03, 0.02, 0.0, 3));
}

TEST_F(ReferenceToolTest, AgreesForJitteredStampsAndFasterReference) {
  const std::vector<TimedPose> truth = CurvedPath(500, 100.0);
  ExpectSameErrors(truth, Disturbed(CurvedPath(150, 30.0), 0.03, 0.02, 0.003, 4));
}

TEST_F(ReferenceToolTest, AgreesForFasterEstimateThatStopsEarly) {
  const std::vector<TimedPose> truth = CurvedPath(120, 15.0);
  ExpectSameErrors(truth, Disturbed(CurvedPath(300, 60.0), 0.03, 0.02, 0.004, 5));
}

TEST_F(ReferenceToolTest, AgreesForGapsInBothTrajectories) {
  std::vector<TimedPose> truth = CurvedPath(300, 30.0);
  std::vector<TimedPose> estimate = Disturbed(truth, 0.05, 0.05, 0.001, 6);
  truth.erase(truth.begin() + 40, truth.begin() + 75);
  estimate.erase(estimate.begin() + 150, estimate.begin() + 160);
  ExpectSameErrors(truth, estimate);
}

}  // namespace
}  // namespace msc_vo
