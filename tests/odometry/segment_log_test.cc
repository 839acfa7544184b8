// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/odometry/segment_log.h"

#include <gtest/gtest.h>

#include "msc_vo/geometry/so3.h"
#include "msc_vo/odometry/pose_correction.h"

namespace msc_vo {
namespace {

FrameResult TrackedAt(const Rigid3& cam_from_world) {
  FrameResult frame;
  frame.status = TrackingStatus::kTracked;
  frame.segment = 0;
  frame.cam_from_world = cam_from_world;
  frame.covariance = IsotropicCovariance(0.01, 0.002);
  return frame;
}

// A loop moves a pose by metres and turns it: the camera is as uncertain in its own frame as it
// was.
TEST(SegmentLog, KeepsTheCovarianceOfTheCameraWhenAPoseIsCorrected) {
  SegmentLog log;
  log.Begin(0, false);
  const std::vector<FrameResult> tracked{TrackedAt({ExpSO3({0.1, 0.2, 0.3}), {4.0, 0.0, 1.0}})};
  std::vector<FrameResult> final = tracked;
  final[0].cam_from_world = Rigid3(ExpSO3({0.0, 0.5, 0.0}), {-3.0, 2.0, 5.0});
  log.PropagateCovariances(tracked, &final);
  const PoseCovariance before = CameraCovariance(tracked[0].cam_from_world, *tracked[0].covariance);
  const PoseCovariance after = CameraCovariance(final[0].cam_from_world, *final[0].covariance);
  EXPECT_LT((after - before).norm(), 1e-9 * before.norm());
  EXPECT_GT((*final[0].covariance - *tracked[0].covariance).norm(), 0.01 * before.norm());
}

// The map of a keyframe was joined with another one, whose world is 20 m away.
TEST(PoseCorrection, KeepsTheCovarianceOfTheCameraInAnotherWorld) {
  FrameResult frame = TrackedAt({ExpSO3({0.1, 0.2, 0.3}), {4.0, 0.0, 1.0}});
  const PoseCovariance before = CameraCovariance(frame.cam_from_world, *frame.covariance);
  const Rigid3 other(ExpSO3({0.0, 0.5, 0.0}), {20.0, 0.0, 1.0});
  ReplacePose(other, &frame);
  EXPECT_EQ(frame.cam_from_world.params, other.params);
  const PoseCovariance after = CameraCovariance(other, *frame.covariance);
  EXPECT_LT((after - before).norm(), 1e-9 * before.norm());
}

}  // namespace
}  // namespace msc_vo
