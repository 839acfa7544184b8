// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/tracking/pose_plausibility.h"

#include <cmath>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "msc_vo/geometry/so3.h"

namespace msc_vo {
namespace {

// A camera that turns at 0.5 radians/second and moves at 0.6 metres/second.
PosePlausibility SlowCamera() {
  PosePlausibility plausibility;
  plausibility.Observe(1.0, {{0.0, 0.5, 0.0}, {0.6, 0.0, 0.0}}, PoseOrigin::kPrediction);
  return plausibility;
}

TEST(PosePlausibility, BelievesAFastMotionThatIsSeen) {
  PosePlausibility plausibility = SlowCamera();
  plausibility.Observe(1.1, {{0.0, 6.0, 0.0}, {5.0, 0.0, 0.0}}, PoseOrigin::kPrediction);
  EXPECT_FALSE(plausibility.IsImplausible(1.1));
  // From now on it is plausible in a gap, too.
  plausibility.Observe(2.0, {{0.0, 6.0, 0.0}, {5.0, 0.0, 0.0}}, PoseOrigin::kAfterGap);
  EXPECT_FALSE(plausibility.IsImplausible(2.0));
}

TEST(PosePlausibility, MarksAJumpInAGapForSomeSeconds) {
  for (const bool turns : {true, false}) {
    PosePlausibility plausibility = SlowCamera();
    const CameraVelocity jump =
        turns ? CameraVelocity{{0.0, 2.0, 0.0}, {}} : CameraVelocity{{}, {0.0, 0.0, 2.0}};
    plausibility.Observe(2.0, jump, PoseOrigin::kAfterGap);
    EXPECT_TRUE(plausibility.IsImplausible(2.0));
    plausibility.Observe(2.1, {{0.0, 0.5, 0.0}, {}}, PoseOrigin::kPrediction);
    EXPECT_TRUE(plausibility.IsImplausible(6.9));
    EXPECT_FALSE(plausibility.IsImplausible(7.1));
  }
}

TEST(PosePlausibility, MarksAFarJumpThatASearchHasFound) {
  const auto is_implausible = [](double angular, double linear) {
    PosePlausibility plausibility = SlowCamera();
    plausibility.Observe(2.0, {{0.0, angular, 0.0}, {linear, 0.0, 0.0}}, PoseOrigin::kSearch);
    return plausibility.IsImplausible(2.0);
  };
  // Three times the limits of a gap: 1.5 radians/second and 1.8 metres/second.
  EXPECT_FALSE(is_implausible(4.0, 5.0));
  EXPECT_TRUE(is_implausible(5.0, 0.0));
  EXPECT_TRUE(is_implausible(0.0, 6.0));
}

TEST(PosePlausibility, LearnsNoSpeedFromASearch) {
  PosePlausibility plausibility = SlowCamera();
  plausibility.Observe(2.0, {{0.0, 4.0, 0.0}, {}}, PoseOrigin::kSearch);
  plausibility.Observe(3.0, {{0.0, 4.0, 0.0}, {}}, PoseOrigin::kAfterGap);
  EXPECT_TRUE(plausibility.IsImplausible(3.0));
}

// The way back from a wrong place is no motion of the camera.
TEST(PosePlausibility, LearnsNoSpeedFromImplausiblePoses) {
  PosePlausibility plausibility = SlowCamera();
  plausibility.MarkImplausible(2.0);
  plausibility.Observe(2.5, {{0.0, 3.1, 0.0}, {4.0, 0.0, 0.0}}, PoseOrigin::kPrediction);
  plausibility.Observe(9.0, {{0.0, 3.1, 0.0}, {4.0, 0.0, 0.0}}, PoseOrigin::kAfterGap);
  EXPECT_TRUE(plausibility.IsImplausible(9.0));
}

TEST(PosePlausibility, RemembersContradictionsByDepth) {
  PosePlausibility plausibility = SlowCamera();
  plausibility.MarkImplausible(2.0);
  EXPECT_TRUE(plausibility.IsImplausible(2.0));
  EXPECT_TRUE(plausibility.IsImplausible(6.9));
  EXPECT_FALSE(plausibility.IsImplausible(7.1));
}

// A covariance whose standard deviations of all axes together are `angle` (radians) and `distance`
// (metres).
PoseCovariance OfJump(double angle, double distance) {
  return IsotropicCovariance(angle / std::sqrt(3.0), distance / std::sqrt(3.0));
}

// The camera may be where the first implausible pose was predicted.
TEST(PosePlausibility, KeepsTheLargestJump) {
  PosePlausibility plausibility = SlowCamera();
  const Rigid3 jump(ExpSO3({0.0, 0.9, 0.0}), {1.5, 0.0, 0.0}), rest;
  EXPECT_TRUE(plausibility.UpdateJumpCovariance(1.9, rest, jump).isZero());
  plausibility.MarkImplausible(2.0);
  EXPECT_TRUE(plausibility.UpdateJumpCovariance(2.0, jump, jump).isApprox(OfJump(0.9, 1.5)));
  const Rigid3 turn(ExpSO3({0.0, 0.5, 0.0}), {0.0, 0.0, 0.0});
  EXPECT_TRUE(plausibility.UpdateJumpCovariance(2.1, turn, rest).isApprox(OfJump(0.9, 1.5)));
  plausibility.MarkImplausible(3.0);
  const Rigid3 longer(Eigen::Quaterniond::Identity(), {0.0, 5.0, 0.0});
  EXPECT_TRUE(plausibility.UpdateJumpCovariance(3.0, rest, longer).isApprox(OfJump(0.0, 5.0)));
  EXPECT_TRUE(plausibility.UpdateJumpCovariance(8.1, rest, rest).isZero());
}

// The camera was not moved, and the place that was found is wrong. The squared error of the pose is
// that which is expected of six degrees of freedom.
TEST(PosePlausibility, CoversThePredictedPose) {
  PosePlausibility plausibility = SlowCamera();
  const Eigen::Vector3d turn(0.4, -1.2, 0.3), move(2.0, 0.5, -1.0);
  plausibility.MarkImplausible(2.0);
  const PoseCovariance covariance =
      plausibility.UpdateJumpCovariance(2.0, Rigid3(), Rigid3(ExpSO3(turn), move));
  Eigen::Matrix<double, 6, 1> error;
  error << turn, move;
  EXPECT_NEAR(error.dot(covariance.inverse() * error), 6.0, 1e-9);
}

TEST(PosePlausibility, BelievesSlowMotionsAfterRest) {
  PosePlausibility plausibility;  // at rest so far
  plausibility.Observe(2.0, {{0.0, 0.8, 0.0}, {0.4, 0.0, 0.0}}, PoseOrigin::kAfterGap);
  EXPECT_FALSE(plausibility.IsImplausible(2.0));
}

}  // namespace
}  // namespace msc_vo
