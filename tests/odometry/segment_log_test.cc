// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/odometry/segment_log.h"

#include <gtest/gtest.h>

#include "msc_vo/geometry/so3.h"
#include "msc_vo/odometry/localization.h"
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

MapJoin Join(SubMapId kept, SubMapId moved, double length) {
  return {kept, moved, Rigid3(Eigen::Quaterniond::Identity(), {length, 0.0, 0.0}),
          IsotropicCovariance(0.01 * length, 0.001), 3};
}

// Map 1 of earlier sessions is found at frame 2, and with it map 0 at frame 4. Without earlier
// sessions these are segments of the run. Map 1 has a join of its own.
TEST(SegmentLog, ASegmentIsFoundWhereItEntersAWorldOfEarlierSessions) {
  for (const int num_earlier : {0, 2}) {
    SegmentLog log;
    log.BeginWith(num_earlier);
    for (int id = num_earlier; id < 3; ++id) {
      log.Begin(id, false);
      log.RecordKeyframe(id, id);
    }
    log.RecordJoin(3, Join(1, 2, 1.0));
    log.RecordJoin(4, Join(0, 1, 10.0));
    std::vector<FrameResult> frames(6, TrackedAt(Rigid3()));
    const std::vector<Segment> segments = log.Segments(frames);
    ASSERT_EQ(segments.size(), 3u);
    EXPECT_EQ(segments[2].world, 0);
    ASSERT_TRUE(segments[2].join);
    EXPECT_EQ(segments[2].join->frame, num_earlier > 0 ? 3 : 4);
    // The lever arm of the alignment is the distance from the origin of the moved world.
    EXPECT_NEAR(segments[2].join->rotation_sigma, num_earlier > 0 ? 0.01 : 0.1, 1e-9);
    ASSERT_TRUE(segments[1].join);
    EXPECT_EQ(segments[1].join->frame, 4);
    EXPECT_NEAR(segments[1].join->rotation_sigma, 0.1, 1e-9);
    EXPECT_FALSE(segments[0].join);
  }
}

// World 0 is of an earlier session. Segment 1 is found at frame 2, segment 2 is not found, segment
// 3 at frame 8.
TEST(SegmentLog, FramesThatAreNotLocalizedBelongToTheSegmentBefore) {
  std::vector<Segment> segments(4);
  segments[0].is_earlier_session = true;
  segments[0].last_frame = -1;
  for (int i = 1; i <= 3; ++i) segments[i] = {3 * i - 3, 3 * i - 1, 3, i == 2 ? 2 : 0, {}, false};
  segments[1].join = SegmentJoin{2, 3};
  segments[3].join = SegmentJoin{8, 3};
  std::vector<FrameResult> frames(9, TrackedAt(Rigid3()));
  for (int i = 0; i < 9; ++i) frames[i].segment = 1 + i / 3;
  KeepLocalizedPoses(&segments, &frames);
  const int expected[] = {kNoSegment, kNoSegment, 1, 1, 1, 1, 1, 1, 3};
  for (int i = 0; i < 9; ++i) {
    EXPECT_EQ(frames[i].segment, expected[i]) << i;
    EXPECT_EQ(IsEstimated(frames[i].status), i == 2 || i == 8) << i;
  }
  EXPECT_EQ(segments[1].first_frame, 2);
  EXPECT_EQ(segments[1].last_frame, 7);
  EXPECT_EQ(segments[1].num_estimated, 1);
  EXPECT_LT(segments[2].last_frame, segments[2].first_frame);
  EXPECT_EQ(segments[2].num_estimated, 0);
  EXPECT_EQ(segments[3].first_frame, 8);
  EXPECT_EQ(segments[3].last_frame, 8);
}

// Worlds 0 and 1 are of earlier sessions.
TEST(SegmentLog, LocalizedPosesNameNoWorldThatWasNotReported) {
  FrameResult frame = TrackedAt(Rigid3());
  frame.world = 0;
  frame.world_changed = WorldChange{2, Rigid3()};
  EXPECT_FALSE(KeepLocalizedPose(2, frame).world_changed);
  frame.world_changed = WorldChange{1, Rigid3()};
  EXPECT_TRUE(KeepLocalizedPose(2, frame).world_changed);
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
