// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <gmock/gmock.h>

#include "msc_vo/geometry/so3.h"
#include "msc_vo/odometry/pose_correction.h"

namespace msc_vo {
namespace {

FrameResult ResultAt(double timestamp, TrackingStatus status, double x, double turn = 0.0) {
  FrameResult frame;
  frame.timestamp = timestamp;
  frame.status = status;
  const Eigen::Quaterniond world_from_cam = ExpSO3({0, turn, 0});
  frame.cam_from_world = Rigid3(world_from_cam, {x, 0, 0}).Inverse();
  return frame;
}

TEST(FillGaps, InterpolatesAtConstantVelocity) {
  std::vector<FrameResult> frames = {ResultAt(0.0, TrackingStatus::kTracked, 0.0, 0.0),
                                     ResultAt(0.1, TrackingStatus::kPredicted, 7.0),
                                     ResultAt(0.3, TrackingStatus::kLost, 7.0),
                                     ResultAt(0.4, TrackingStatus::kWeak, 4.0, 0.8)};
  FillGaps({}, &frames);
  for (const FrameResult& frame : frames) {
    EXPECT_NEAR(frame.cam_from_world.OriginInSource().x(), 10.0 * frame.timestamp, 1e-12);
    const Eigen::Vector3d turn = LogSO3(frame.cam_from_world.Inverse().rotation());
    EXPECT_NEAR(turn.y(), 2.0 * frame.timestamp, 1e-12);
  }
  EXPECT_EQ(frames[2].status, TrackingStatus::kLost);
}

TEST(FillGaps, KeepsPosesOfPoseFactorsAndInterpolatesBetweenThem) {
  std::vector<FrameResult> frames = {
      ResultAt(0.0, TrackingStatus::kTracked, 0.0), ResultAt(0.1, TrackingStatus::kPredicted, 5.0),
      ResultAt(0.2, TrackingStatus::kDropped, 5.0), ResultAt(0.3, TrackingStatus::kPredicted, 9.0),
      ResultAt(0.4, TrackingStatus::kTracked, 2.0)};
  frames[1].by_pose_factors = frames[3].by_pose_factors = true;
  FillGaps({}, &frames);
  std::vector<double> x;
  for (const FrameResult& frame : frames) x.push_back(frame.cam_from_world.OriginInSource().x());
  EXPECT_THAT(x, testing::Pointwise(testing::DoubleNear(1e-12), {0.0, 5.0, 7.0, 9.0, 2.0}));
}

TEST(FillGaps, KeepsTheEndsAndEstimatedFrames) {
  const std::vector<FrameResult> before = {
      ResultAt(0.0, TrackingStatus::kLost, 1.0), ResultAt(0.1, TrackingStatus::kTracked, 2.0),
      ResultAt(0.2, TrackingStatus::kTracked, 5.0), ResultAt(0.3, TrackingStatus::kPredicted, 9.0)};
  std::vector<FrameResult> after = before;
  FillGaps({}, &after);
  for (size_t i = 0; i < before.size(); ++i) {
    EXPECT_EQ(after[i].cam_from_world.params, before[i].cam_from_world.params) << i;
  }
  std::vector<FrameResult> none;
  FillGaps({}, &none);
}

TEST(FillGaps, DoesNotInterpolateBetweenWorlds) {
  std::vector<FrameResult> frames = {
      ResultAt(0.0, TrackingStatus::kTracked, 0.0), ResultAt(0.1, TrackingStatus::kLost, 7.0),
      ResultAt(0.2, TrackingStatus::kTracked, 8.0), ResultAt(0.3, TrackingStatus::kLost, 9.0),
      ResultAt(0.4, TrackingStatus::kTracked, 4.0)};
  frames[2].segment = frames[3].segment = 1;
  frames[4].segment = 2;
  std::vector<Segment> segments(3);
  segments[1].world = 1;
  segments[2].world = 1;  // joined with the one before
  FillGaps(segments, &frames);
  EXPECT_EQ(frames[1].cam_from_world.OriginInSource().x(), 7.0);
  EXPECT_NEAR(frames[3].cam_from_world.OriginInSource().x(), 6.0, 1e-12);
}

}  // namespace
}  // namespace msc_vo
