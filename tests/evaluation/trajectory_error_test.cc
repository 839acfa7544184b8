// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/evaluation/trajectory_error.h"

#include <algorithm>
#include <cmath>

#include "tests/evaluation/curved_path.h"
#include "tests/support/message_matchers.h"
#include <gtest/gtest.h>

namespace msc_vo {
namespace {

TimedPose At(double time, double x, double y, double z) {
  return {time, Rigid3(Eigen::Quaterniond::Identity(), {x, y, z})};
}

// Corners of a square with side 2. The alignment is the identity by symmetry, because the offsets
// below sum to zero and have no moment.
std::vector<TimedPose> Square() {
  return {At(0.0, 1, 1, 0), At(1.0, -1, 1, 0), At(2.0, -1, -1, 0), At(3.0, 1, -1, 0)};
}

TEST(EvaluateTrajectory, ReferenceHasZeroError) {
  const std::vector<TimedPose> path = CurvedPath(200, 30.0);
  const TrajectoryError error = EvaluateTrajectory(path, path);
  ASSERT_TRUE(error.usable);
  EXPECT_EQ(error.num_matched, 200);
  EXPECT_NEAR(error.ape.max, 0.0, 1e-12);
  EXPECT_NEAR(error.ape_rotation.max, 0.0, 1e-7);
  EXPECT_NEAR(error.rpe_per_second.translation.max, 0.0, 1e-12);
  EXPECT_NEAR(error.rpe_per_metre.rotation.max, 0.0, 1e-7);
  EXPECT_EQ(error.coverage, 1.0);
}

TEST(EvaluateTrajectory, AbsoluteErrorMatchesHandComputedValues) {
  std::vector<TimedPose> estimate = Square();
  // +h and -h along z at opposite corners: mean zero, and the best rotation stays the identity
  // because the moments about both diagonals cancel.
  const double h = 0.1;
  const double offsets[] = {h, -h, h, -h};
  for (int i = 0; i < 4; ++i) estimate[i].world_from_cam.translation().z() += offsets[i];
  const TrajectoryError error = EvaluateTrajectory(Square(), estimate);
  ASSERT_TRUE(error.usable);
  EXPECT_NEAR(error.ape.rmse, h, 1e-12);
  EXPECT_NEAR(error.ape.mean, h, 1e-12);
  EXPECT_NEAR(error.ape.median, h, 1e-12);
  EXPECT_NEAR(error.ape.max, h, 1e-12);
  EXPECT_NEAR(error.path_length, 6.0, 1e-12);
  // Each motion over one second has an error of 2 h.
  EXPECT_EQ(error.rpe_per_second.translation.count, 3);
  EXPECT_NEAR(error.rpe_per_second.translation.rmse, 2 * h, 1e-12);
  // The first pose at least 1 m further along the path is 2 m away.
  EXPECT_EQ(error.rpe_per_metre.translation.count, 3);
  EXPECT_NEAR(error.rpe_per_metre.translation.mean, h, 1e-12);
}

// Moved by 0.5 along x and turned by 0.1 about the vertical.
std::vector<TimedPose> Moved(const std::vector<TimedPose>& path) {
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitZ()));
  return Transformed(Rigid3(turn, {0.5, 0.0, 0.0}), path);
}

TEST(EvaluateTrajectory, AlignsAsTheOptionsSay) {
  const std::vector<TimedPose> path = CurvedPath(200, 30.0);
  EvaluationOptions options;
  for (const Alignment alignment : {Alignment::kSe3, Alignment::kSim3, Alignment::kOrigin}) {
    options.alignment = alignment;
    const TrajectoryError error = EvaluateTrajectory(path, Moved(path), options);
    EXPECT_NEAR(error.ape.max, 0.0, 1e-9);
    EXPECT_NEAR(error.rotation.max, 0.0, 1e-6);
  }
  options.alignment = Alignment::kNone;
  const TrajectoryError error = EvaluateTrajectory(path, Moved(path), options);
  EXPECT_TRUE(error.reference_from_estimate.params == Rigid3().params);
  EXPECT_NEAR(error.rotation.rmse, 0.1, 1e-9);
  EXPECT_NEAR(error.ape_rotation.rmse, 0.1, 1e-9);
  const std::vector<TimedPose> shifted =
      Transformed(Rigid3(Eigen::Quaterniond::Identity(), {0.5, 0.0, 0.0}), path);
  EXPECT_NEAR(EvaluateTrajectory(path, shifted, options).ape.rmse, 0.5, 1e-9);
  EXPECT_THROW(AlignmentFromString("scale"), std::invalid_argument);
}

TEST(EvaluateTrajectory, RotationErrorMatchesHandComputedValues) {
  std::vector<TimedPose> estimate = Square();
  const double angle = 0.2;
  for (TimedPose& pose : estimate) {
    pose.world_from_cam.rotation() = ExpSO3({0.0, angle, 0.0});
  }
  const TrajectoryError error = EvaluateTrajectory(Square(), estimate);
  ASSERT_TRUE(error.usable);
  EXPECT_NEAR(error.ape.rmse, 0.0, 1e-12);
  EXPECT_NEAR(error.ape_rotation.rmse, angle, 1e-12);
  EXPECT_NEAR(error.rpe_per_second.rotation.rmse, 0.0, 1e-12);
  // A motion of 2 m expressed in a camera frame rotated by `angle`.
  EXPECT_GT(error.rpe_per_second.translation.rmse, 0.1);
}

TEST(EvaluateTrajectory, RotationErrorDoesNotDependOnPositionAlignment) {
  // The camera rotates in place: 1 mm of noise determines the alignment of positions.
  std::vector<TimedPose> truth;
  for (int i = 0; i < 100; ++i) {
    truth.push_back({i / 30.0, Rigid3(ExpSO3({0.0, 0.01 * i, 0.0}), {1e-4 * i, 0.0, 0.0})});
  }
  std::vector<TimedPose> estimate = Disturbed(truth, 0.001, 0.0, 0.0, 1);
  estimate = Transformed(Rigid3(ExpSO3({0.5, -1.2, 0.3}), {3.0, -4.0, 5.0}), estimate);
  const TrajectoryError error = EvaluateTrajectory(truth, estimate);
  EXPECT_GT(error.ape_rotation.rmse, 0.1);
  EXPECT_NEAR(error.rotation.max, 0.0, 1e-7);
  // Alternating orientation errors of +0.02 and -0.02 rad.
  for (int i = 0; i < 100; ++i) {
    Rigid3& pose = estimate[i].world_from_cam;
    pose.rotation() = pose.rotation() * ExpSO3({i % 2 == 0 ? 0.02 : -0.02, 0.0, 0.0});
  }
  EXPECT_NEAR(EvaluateTrajectory(truth, estimate).rotation.rmse, 0.02, 1e-4);
}

TEST(EvaluateTrajectory, IgnoresPosesThatAreNotEstimated) {
  const std::vector<TimedPose> truth = CurvedPath(100, 30.0);
  std::vector<TimedPose> estimate = truth;
  for (int i = 60; i < 100; ++i) {
    estimate[i].is_estimated = false;
    estimate[i].world_from_cam = estimate[59].world_from_cam;
  }
  TrajectoryError error = EvaluateTrajectory(truth, estimate);
  ASSERT_TRUE(error.usable);
  EXPECT_EQ(error.num_estimate, 60);
  EXPECT_EQ(error.num_not_estimated, 40);
  EXPECT_DOUBLE_EQ(error.coverage, 0.6);
  EXPECT_NEAR(error.ape.max, 0.0, 1e-9);
  EXPECT_NEAR(error.rpe_per_second.translation.max, 0.0, 1e-9);
  EXPECT_NEAR(AlignOrientations(truth, estimate)->translation().norm(), 0.0, 1e-9);

  EvaluationOptions all;
  all.all_poses = true;
  error = EvaluateTrajectory(truth, estimate, all);
  EXPECT_EQ(error.num_not_estimated, 0);
  EXPECT_EQ(error.coverage, 1.0);
  EXPECT_GT(error.ape.max, 0.05);

  for (TimedPose& pose : estimate) pose.is_estimated = false;
  error = EvaluateTrajectory(truth, estimate);
  EXPECT_FALSE(error.usable);
  EXPECT_THAT(error.message, Names("100", "not estimated"));
  EXPECT_EQ(DescribeRemedy(error, "--all-poses"), "--all-poses compares them");
}

TEST(EvaluateTrajectory, DoesNotDependOnWorldFrame) {
  const std::vector<TimedPose> truth = CurvedPath(300, 30.0);
  const std::vector<TimedPose> estimate = Disturbed(truth, 0.02, 0.01, 0.0, 1);
  const Rigid3 shift(ExpSO3({0.5, -1.2, 0.3}), {3.0, -4.0, 5.0});
  const TrajectoryError a = EvaluateTrajectory(truth, estimate);
  const TrajectoryError b = EvaluateTrajectory(truth, Transformed(shift, estimate));
  EXPECT_NEAR(a.ape.rmse, b.ape.rmse, 1e-10);
  EXPECT_NEAR(a.ape_rotation.rmse, b.ape_rotation.rmse, 1e-10);
  EXPECT_NEAR(a.rpe_per_second.translation.rmse, b.rpe_per_second.translation.rmse, 1e-10);
  EXPECT_NEAR(a.rpe_per_metre.rotation.rmse, b.rpe_per_metre.rotation.rmse, 1e-10);
  EXPECT_NEAR(a.ape.rmse, 0.02 * std::sqrt(3.0), 0.003);
}

TEST(EvaluateTrajectory, DoesNotDependOnOrderOfPoses) {
  const std::vector<TimedPose> truth = CurvedPath(100, 30.0);
  std::vector<TimedPose> estimate = Disturbed(truth, 0.02, 0.01, 0.0, 2);
  const double expected = EvaluateTrajectory(truth, estimate).ape.rmse;
  std::reverse(estimate.begin(), estimate.end());
  EXPECT_EQ(EvaluateTrajectory(truth, estimate).ape.rmse, expected);
}

TEST(EvaluateTrajectory, ReportsWrongScale) {
  const std::vector<TimedPose> truth = CurvedPath(100, 30.0);
  std::vector<TimedPose> estimate = truth;
  for (TimedPose& pose : estimate) pose.world_from_cam.translation() *= 1.1;
  EXPECT_GT(EvaluateTrajectory(truth, estimate).ape.rmse, 0.01);
}

TEST(EvaluateTrajectory, CountsMissingPoses) {
  const std::vector<TimedPose> truth = CurvedPath(100, 30.0);
  const std::vector<TimedPose> estimate(truth.begin() + 20, truth.begin() + 60);
  const TrajectoryError error = EvaluateTrajectory(truth, estimate);
  ASSERT_TRUE(error.usable);
  EXPECT_EQ(error.num_matched, 40);
  EXPECT_EQ(error.num_reference, 100);
  EXPECT_EQ(error.num_reference_in_range, 40);
  EXPECT_DOUBLE_EQ(error.coverage, 0.4);
  EXPECT_DOUBLE_EQ(error.coverage_in_range, 1.0);
}

TEST(EvaluateTrajectory, DoubtsFewMatchesAtCommonTimes) {
  const std::vector<TimedPose> truth = CurvedPath(100, 5.0);
  EXPECT_THAT(EvaluateTrajectory(truth, truth).warnings, testing::IsEmpty());
  std::vector<TimedPose> sparse;
  for (size_t i = 0; i < truth.size(); i += 10) sparse.push_back(truth[i]);
  EXPECT_THAT(EvaluateTrajectory(truth, sparse).warnings, testing::IsEmpty());
  EXPECT_THAT(EvaluateTrajectory(sparse, truth).warnings, testing::IsEmpty());
  // Two clocks that are not synchronised.
  std::vector<TimedPose> shifted = truth;
  for (TimedPose& pose : shifted) pose.timestamp += 0.05;
  EvaluationOptions options;
  options.max_time_difference = 0.06;
  EXPECT_THAT(EvaluateTrajectory(truth, shifted, options).warnings, testing::IsEmpty());

  const std::vector<TimedPose> dense = CurvedPath(3000, 30.0);
  // Every 125th pose, of which one in eight is on time: 240 poses per second whose milliseconds
  // were read as seconds.
  std::vector<TimedPose> slow;
  for (size_t i = 0; i < dense.size(); i += 125) {
    slow.push_back(dense[i]);
    if (i % 1000 != 0) slow.back().timestamp += 0.015;
  }
  options.max_time_difference = 0.01;
  const TrajectoryError error = EvaluateTrajectory(slow, dense, options);
  ASSERT_TRUE(error.usable);
  EXPECT_THAT(error.warnings, testing::Contains(Names("of 24 poses", "time stamps")));
}

TEST(EvaluateTrajectory, IsNotUsableWithTooFewMatches) {
  const std::vector<TimedPose> truth = CurvedPath(100, 30.0);
  std::vector<TimedPose> estimate = truth;
  for (TimedPose& pose : estimate) pose.timestamp += 1000.0;
  const TrajectoryError error = EvaluateTrajectory(truth, estimate);
  EXPECT_FALSE(error.usable);
  EXPECT_THAT(error.message, Names("0", "100"));
  EXPECT_THAT(DescribeRemedy(error, "--all-poses"), Names("clock"));
  EXPECT_EQ(DescribeRemedy(EvaluateTrajectory(truth, truth), "--all-poses"), "");
  EXPECT_FALSE(EvaluateTrajectory({}, {}).usable);
}

TEST(EvaluateTrajectory, MatchesPosesOfTheSameTimeInOrder) {
  std::vector<TimedPose> path = CurvedPath(90, 30.0);
  for (TimedPose& pose : path) pose.timestamp = std::floor(10.0 * pose.timestamp) / 10.0;
  const TrajectoryError error = EvaluateTrajectory(path, path);
  EXPECT_EQ(error.num_matched, 90);
  EXPECT_NEAR(error.ape.max, 0.0, 1e-9);
}

TEST(EvaluateTrajectory, AlignsNoScaleToPositionsThatAreTheSame) {
  const std::vector<TimedPose> path = CurvedPath(50, 30.0);
  std::vector<TimedPose> still = path;
  for (TimedPose& pose : still) pose.world_from_cam.translation() = Eigen::Vector3d(3, 4, 5);
  EvaluationOptions options;
  options.alignment = Alignment::kSim3;
  const TrajectoryError of_reference = EvaluateTrajectory(still, path, options);
  EXPECT_FALSE(of_reference.usable);
  EXPECT_THAT(of_reference.message, Names("reference", "scale"));
  const TrajectoryError of_estimate = EvaluateTrajectory(path, still, options);
  EXPECT_FALSE(of_estimate.usable);
  EXPECT_THAT(of_estimate.message, Names("estimate", "scale"));
}

TEST(EvaluateTrajectory, ThrowsOnInvalidOptions) {
  EvaluationOptions options;
  options.rpe_metres = 0.0;
  EXPECT_THROW(EvaluateTrajectory({}, {}, options), std::invalid_argument);
  options = {};
  options.max_time_difference = -1.0;
  EXPECT_THROW(EvaluateTrajectory({}, {}, options), std::invalid_argument);
}

TEST(AlignOrientations, DeterminesRotationAboutStraightPath) {
  const Rigid3 truth(ExpSO3({0.3, -0.2, 0.5}), {1.0, 2.0, 3.0});
  std::vector<TimedPose> reference, estimate;
  for (int i = 0; i < 10; ++i) {
    reference.push_back(At(i, i, 0.0, 0.0));
    estimate.push_back({0.001 + i, truth.Inverse() * reference.back().world_from_cam});
    // Alternating by 1 mm: positions alone do not determine the rotation about the path.
    estimate.back().world_from_cam.translation().z() += i % 2 == 0 ? 1e-3 : -1e-3;
  }
  const std::optional<Rigid3> alignment = AlignOrientations(reference, estimate);
  ASSERT_TRUE(alignment.has_value());
  EXPECT_LT(alignment->rotation().angularDistance(truth.rotation()), 1e-9);
  EXPECT_LT((alignment->translation() - truth.translation()).norm(), 1e-9);
  EXPECT_FALSE(AlignOrientations(reference, {At(100.0, 0, 0, 0)}).has_value());
  EvaluationOptions options;
  options.max_time_difference = -1.0;
  EXPECT_THROW(AlignOrientations(reference, estimate, options), std::invalid_argument);
}

}  // namespace
}  // namespace msc_vo
