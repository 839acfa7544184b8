// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/odometry/odometry_pose.h"

#include <cmath>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "msc_vo/geometry/so3.h"
#include "msc_vo/tracking/tracked_frame.h"

namespace msc_vo {
namespace {

// Frames at 10 Hz of a camera that moves by kStep per frame.
class OdometryPoseTest : public testing::Test {
 protected:
  static Rigid3 Steps(int count) {
    Rigid3 motion;
    for (int i = 0; i < count; ++i) motion = step() * motion;
    return motion;
  }
  static Rigid3 step() { return {ExpSO3({0.0, 0.02, 0.0}), {0.05, 0.0, 0.01}}; }

  // The frame `steps` after the last one that was estimated; none: it begins a map.
  void Add(TrackingStatus status, std::optional<int> steps, bool is_keyframe = false,
           bool is_jump = false) {
    TrackedFrame tracked;
    tracked.is_jump = is_jump;
    auto frame = std::make_shared<Frame>();
    frame->timestamp = 0.1 * index_++;
    tracked.frame = frame;
    tracked.status = status;
    if (steps) tracked.cam_from_last = Steps(*steps);
    if (is_keyframe) tracked.keyframe.id = 1;
    tracked.pose.usable = IsEstimated(status) && steps;
    tracked.pose.covariance = IsotropicCovariance(1e-4, 1e-3);
    const Rigid3 before = pose_.cam_from_odometry();
    pose_.Add(tracked);
    last_step_ = pose_.cam_from_odometry() * before.Inverse();
  }
  void AddJump(int steps) { Add(TrackingStatus::kWeak, steps, false, true); }
  void Skip(int count) { index_ += count; }
  void ExpectLastStep(const Rigid3& expected, double tolerance = 1e-9) const {
    EXPECT_TRUE(last_step_.params.isApprox(expected.params, tolerance))
        << last_step_.params.transpose();
  }

  OdometryPose pose_;
  Rigid3 last_step_;
  int index_ = 0;
};

TEST_F(OdometryPoseTest, IntegratesTheMotionFromTheFirstFrameOn) {
  Add(TrackingStatus::kLost, {});
  EXPECT_EQ(pose_.cam_from_odometry().params, Rigid3().params);
  Add(TrackingStatus::kTracked, {}, true);
  EXPECT_EQ(pose_.cam_from_odometry().params, Rigid3().params);
  for (int i = 1; i < 6; ++i) {
    Add(i % 2 == 0 ? TrackingStatus::kWeak : TrackingStatus::kTracked, 1);
    EXPECT_TRUE(pose_.cam_from_odometry().params.isApprox(Steps(i).params, 1e-12)) << i;
  }
}

TEST_F(OdometryPoseTest, KeepsTheMotionOfImagesThatAreMissing) {
  Add(TrackingStatus::kTracked, {}, true);
  Add(TrackingStatus::kTracked, 1);
  Skip(3);
  Add(TrackingStatus::kTracked, 4);
  ExpectLastStep(Steps(4));
}

TEST_F(OdometryPoseTest, DoesNotJumpAfterAGap) {
  Add(TrackingStatus::kTracked, {}, true);
  Add(TrackingStatus::kTracked, 1);
  Add(TrackingStatus::kPredicted, 3);  // the prediction is too fast
  ExpectLastStep(Steps(3));
  Add(TrackingStatus::kLost, 3);
  ExpectLastStep(Rigid3());
  Add(TrackingStatus::kLost, 3);
  Add(TrackingStatus::kTracked, 4);  // found again where the camera is
  ExpectLastStep(step(), 0.01);      // by the mean velocity over the gap
  Add(TrackingStatus::kTracked, 1);
  ExpectLastStep(step());
}

// As when the camera was moved while no image was recorded, and is found in another place.
TEST_F(OdometryPoseTest, RestsDuringAJump) {
  Add(TrackingStatus::kTracked, {}, true);
  Add(TrackingStatus::kTracked, 1);
  AddJump(50);
  ExpectLastStep(Rigid3());
  const double variance = pose_.covariance()->bottomRightCorner<3, 3>().trace();
  EXPECT_GT(std::sqrt(variance), 0.9 * Steps(50).translation().norm());
  Add(TrackingStatus::kWeak, 1);
  ExpectLastStep(step());
}

TEST_F(OdometryPoseTest, DoesNotJumpWhereAMapBegins) {
  Add(TrackingStatus::kTracked, {}, true);
  Add(TrackingStatus::kTracked, 1);
  Add(TrackingStatus::kLost, 2);
  Add(TrackingStatus::kTracked, {}, true);
  ExpectLastStep(Rigid3());
  Add(TrackingStatus::kTracked, 1);
  ExpectLastStep(step());
}

// Pose factors move the camera on to another part of the map, which a keyframe begins.
TEST_F(OdometryPoseTest, GoesOnFromAKeyframeWithoutImage) {
  Add(TrackingStatus::kTracked, {}, true);
  Add(TrackingStatus::kPredicted, 1);
  Add(TrackingStatus::kPredicted, 2, true);
  ExpectLastStep(step());
  Add(TrackingStatus::kTracked, 1);
  ExpectLastStep(step());
}

// Standard deviation of the camera's position, metres.
double PositionSigma(const OdometryPose& pose) {
  return std::sqrt(CameraCovariance(pose.cam_from_odometry(), *pose.covariance())
                       .bottomRightCorner<3, 3>()
                       .trace());
}

TEST_F(OdometryPoseTest, HasACovarianceThatGrowsWithThePath) {
  Add(TrackingStatus::kTracked, {}, true);
  EXPECT_FALSE(pose_.covariance());  // a definition
  Add(TrackingStatus::kTracked, 1);
  double before = PositionSigma(pose_);
  // Its pose, 2 mm for the landmarks, 5 mm per metre, and 0.5 % of 2.5 m times the change of the
  // direction of view.
  EXPECT_NEAR(
      before,
      std::sqrt(3.0 * (1e-6 + 4e-6 + std::pow(0.005 * 0.051, 2) + std::pow(0.005 * 2.5 * 0.02, 2))),
      1e-6);
  for (int i = 0; i < 20; ++i) {
    Add(TrackingStatus::kTracked, 1, true);
    EXPECT_GT(PositionSigma(pose_), before) << i;
    before = PositionSigma(pose_);
  }
  // 20 keyframes, each with four times the variance of its pose; 1 m with 5 mm of each axis.
  EXPECT_GT(before, std::sqrt(3.0 * (20.0 * 4e-6 + 25e-6)));
  EXPECT_LT(before, 2.0 * std::sqrt(3.0 * (20.0 * 4e-6 + 25e-6)));
  // Without keyframes, only the distance counts.
  for (int i = 0; i < 4; ++i) Add(TrackingStatus::kTracked, 1);
  EXPECT_LT(PositionSigma(pose_), 1.3 * before);
}

TEST_F(OdometryPoseTest, HasTheMissedMotionInItsCovariance) {
  Add(TrackingStatus::kTracked, {}, true);
  Add(TrackingStatus::kTracked, 1);
  const double before = PositionSigma(pose_);
  Add(TrackingStatus::kLost, 0);
  EXPECT_FALSE(pose_.covariance());
  Add(TrackingStatus::kTracked, 20);  // half of which the pose goes on by
  const Rigid3 missing = pose_.cam_from_odometry() * Steps(21).Inverse();
  const Eigen::Vector3d error = missing.translation();
  ASSERT_GT(error.norm(), 0.3);
  EXPECT_NEAR(PositionSigma(pose_), error.norm(), 0.1 * error.norm());
  EXPECT_GT(PositionSigma(pose_), before);
  const PoseCovariance camera = CameraCovariance(pose_.cam_from_odometry(), *pose_.covariance());
  EXPECT_LT(error.dot(camera.bottomRightCorner<3, 3>().inverse() * error), 1.0);
}

TEST_F(OdometryPoseTest, IsUnknownWhereAMapBegins) {
  Add(TrackingStatus::kTracked, {}, true);
  Add(TrackingStatus::kTracked, 1);
  Add(TrackingStatus::kLost, 1);
  Skip(19);
  Add(TrackingStatus::kTracked, {}, true);
  Add(TrackingStatus::kTracked, 1);
  EXPECT_GT(PositionSigma(pose_), 1.0);  // 2 s without an image
}

}  // namespace
}  // namespace msc_vo
