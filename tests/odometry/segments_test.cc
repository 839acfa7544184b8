// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <algorithm>

#include "tests/support/rendered_images.h"
#include <gmock/gmock.h>

#include "msc_vo/evaluation/segment_error.h"
#include "msc_vo/odometry/odometry.h"

namespace msc_vo {
namespace {

// Shorter times than the defaults keep the sequences short.
OdometryOptions QuickOptions(int threads = 1) {
  OdometryOptions options;
  options.threads = threads;
  options.tracking.max_prediction = 0.2;
  options.tracking.segments.min_search = 0.3;
  options.tracking.segments.search_interval = 0.1;
  return options;
}

class SegmentsTest : public RoomTest {
 protected:
  static void SetUpTestSuite() {
    RoomTest::SetUpTestSuite();
    SyntheticSequenceOptions other = RoomOptions();
    other.seed = 7;
    other_room_ = new std::vector<RgbdImage>(RenderImages(other, 30));
  }
  static void TearDownTestSuite() {
    delete other_room_;
    RoomTest::TearDownTestSuite();
  }

  // Appends images `first` to `last` of a room to the sequence, with ground truth in its world.
  void Append(const std::vector<RgbdImage>& room, int first, int last) {
    for (int i = first; i <= last; ++i) {
      RgbdImage image = room[i];
      image.id = static_cast<int64_t>(sequence_.size());
      image.timestamp = image.id / 30.0;
      sequence_.push_back(image);
      sequence_truth_.push_back({image.timestamp, (*truth_)[i].world_from_cam});
    }
  }

  OdometryResult Run(const OdometryOptions& options) const {
    Odometry odometry(options, camera_, LensDistortion());
    for (const RgbdImage& image : sequence_) odometry.Process(image);
    return odometry.Finish();
  }

  // APE RMSE in metres over the estimated frames of a world, by the truth of the first room.
  double WorldError(const OdometryResult& result, int world) const {
    std::vector<TimedPose> poses;
    for (const FrameResult& frame : result.frames) {
      if (frame.segment == kNoSegment || !IsEstimated(frame.status)) continue;
      if (result.segments[frame.segment].world != world) continue;
      poses.push_back({frame.timestamp, frame.cam_from_world.Inverse()});
    }
    return EvaluateTrajectory(sequence_truth_, poses).ape.rmse;
  }

  static inline std::vector<RgbdImage>* other_room_ = nullptr;
  std::vector<RgbdImage> sequence_;
  std::vector<TimedPose> sequence_truth_;
};

TEST_F(SegmentsTest, IsOneForARunThatLosesNothing) {
  Append(*images_, 0, 29);
  const OdometryResult result = Run(QuickOptions());
  ASSERT_EQ(result.segments.size(), 1u);
  EXPECT_EQ(result.segments[0].first_frame, 0);
  EXPECT_EQ(result.segments[0].last_frame, 29);
  EXPECT_EQ(result.segments[0].num_estimated, 30);
  EXPECT_FALSE(result.segments[0].join.has_value());
  for (const FrameResult& frame : result.frames) EXPECT_EQ(frame.segment, 0);
}

TEST_F(SegmentsTest, BeginsInAnotherRoomAndJoinsWhenItReturns) {
  Append(*images_, 0, 29);
  Append(*other_room_, 0, 29);
  Append(*images_, 10, 45);
  const OdometryResult result = Run(QuickOptions());
  ASSERT_EQ(result.segments.size(), 3u);
  EXPECT_EQ(result.segments[0].world, 0);
  EXPECT_EQ(result.segments[1].world, 1);
  EXPECT_FALSE(result.segments[1].join.has_value());
  EXPECT_EQ(result.segments[2].world, 0);
  ASSERT_TRUE(result.segments[2].join.has_value());
  EXPECT_GE(result.segments[2].join->num_keyframes, 3);
  EXPECT_GT(result.segments[2].join->translation_sigma, 0.01);
  EXPECT_GT(result.segments[2].num_estimated, 15);
  EXPECT_EQ(result.map_world, 0);
  // The two visits of the first room are in one world.
  EXPECT_LT(WorldError(result, 0), 0.02);
  // Frames before the join carry its covariance.
  const FrameResult& first = result.frames[result.segments[2].first_frame];
  EXPECT_GT(first.covariance(5, 5), 1e-4);
}

TEST_F(SegmentsTest, AreTheSameAtAnyThreadCount) {
  Append(*images_, 0, 29);
  Append(*other_room_, 0, 29);
  Append(*images_, 10, 45);
  const OdometryResult one = Run(QuickOptions(1));
  const OdometryResult two = Run(QuickOptions(2));
  ASSERT_EQ(one.frames.size(), two.frames.size());
  for (size_t i = 0; i < one.frames.size(); ++i) {
    EXPECT_EQ(one.frames[i].cam_from_world.params, two.frames[i].cam_from_world.params) << i;
    EXPECT_EQ(one.frames[i].segment, two.frames[i].segment) << i;
  }
}

TEST_F(SegmentsTest, GiveNoPoseToFramesBeforeTheFirstOne) {
  Append(*images_, 0, 29);
  for (int i = 0; i < 5; ++i) Cover(&sequence_[i]);
  const OdometryResult result = Run(QuickOptions());
  ASSERT_EQ(result.segments.size(), 1u);
  EXPECT_EQ(result.segments[0].first_frame, 5);
  for (int i = 0; i < 30; ++i) {
    EXPECT_EQ(result.frames[i].segment, i < 5 ? kNoSegment : 0) << i;
    EXPECT_EQ(result.frames[i].status, i < 5 ? TrackingStatus::kLost : TrackingStatus::kTracked);
  }
}

TEST_F(SegmentsTest, DiscardAWrongStart) {
  Append(*other_room_, 0, 0);  // nothing is tracked after it
  Append(*images_, 0, 39);
  const OdometryResult result = Run(QuickOptions());
  ASSERT_EQ(result.segments.size(), 1u);
  EXPECT_GT(result.segments[0].first_frame, 1);
  EXPECT_LT(result.segments[0].first_frame, 10);
  EXPECT_EQ(result.frames[0].status, TrackingStatus::kLost);
  EXPECT_EQ(result.frames[0].segment, kNoSegment);
  EXPECT_FALSE(result.frames[0].is_keyframe);
  EXPECT_GT(result.segments[0].num_estimated, 30);
  EXPECT_LT(WorldError(result, 0), 0.02);
}

TEST_F(SegmentsTest, AreNotBegunIfDisabled) {
  Append(*images_, 0, 9);
  Append(*other_room_, 0, 29);
  OdometryOptions options = QuickOptions();
  options.tracking.segments.enabled = false;
  const OdometryResult result = Run(options);
  EXPECT_EQ(result.segments.size(), 1u);
  EXPECT_EQ(result.frames.back().status, TrackingStatus::kLost);
}

TEST_F(SegmentsTest, KeepGoingInRealTime) {
  Append(*images_, 0, 29);
  Append(*other_room_, 0, 29);
  OdometryOptions options = QuickOptions(2);
  options.snapshots.realtime = true;
  options.snapshots.insertion_latency = 0.15;
  options.snapshots.latency = 0.15;
  const OdometryResult result = Run(options);
  ASSERT_EQ(result.segments.size(), 2u);
  // The map of the second segment is waited for: its second frame is tracked in it.
  const size_t second = result.segments[1].first_frame + 1;
  EXPECT_EQ(result.frames[second].status, TrackingStatus::kTracked);
}

}  // namespace
}  // namespace msc_vo
