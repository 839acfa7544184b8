// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <algorithm>
#include <optional>

#include "tests/support/rendered_images.h"
#include <gmock/gmock.h>

#include "msc_vo/evaluation/trajectory_error.h"
#include "msc_vo/odometry/odometry.h"

namespace msc_vo {
namespace {

using ::testing::AnyOf;
using ::testing::ElementsAre;

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
    other_truth_ = new std::vector<TimedPose>(TruePoses(other, 30));
  }
  static void TearDownTestSuite() {
    delete other_room_;
    delete other_truth_;
    RoomTest::TearDownTestSuite();
  }

  // Appends images `first` to `last` of a room to the sequence, with ground truth in its world.
  void Append(const std::vector<RgbdImage>& room, int first, int last) {
    for (int i = first; i <= last; ++i) {
      RgbdImage image = room[i];
      image.id = static_cast<int64_t>(sequence_.size());
      image.timestamp = image.id / 30.0;
      sequence_.push_back(image);
      const std::vector<TimedPose>& truth = &room == other_room_ ? *other_truth_ : *truth_;
      sequence_truth_.push_back({image.timestamp, truth[i].world_from_cam});
    }
  }

  OdometryResult Run(const OdometryOptions& options) const {
    Odometry odometry(options, camera_, LensDistortion());
    for (const RgbdImage& image : sequence_) odometry.Process(image);
    return odometry.Finish();
  }

  // Thirty images of the first room, thirty of another one, and the first room again.
  void AppendVisits() {
    Append(*images_, 0, 29);
    Append(*other_room_, 0, 29);
    Append(*images_, 10, 45);
  }
  // What Process() returns for every image, and the final result. Finish() is called after every
  // `finish_interval` images, too; 0: only at the end.
  OdometryResult RunLive(const OdometryOptions& options, std::vector<FrameResult>* live,
                         int finish_interval = 0) const {
    Odometry odometry(options, camera_, LensDistortion());
    for (const RgbdImage& image : sequence_) {
      live->push_back(odometry.Process(image));
      if (finish_interval > 0 && image.id % finish_interval == 0) odometry.Finish();
    }
    return odometry.Finish();
  }
  // The motion from frame i - 1 to frame i; none if the images show different places.
  std::optional<Rigid3> TrueStep(size_t i) const {
    if (i == 0 || i == 30 || i == 60) return std::nullopt;
    return sequence_truth_[i].world_from_cam.Inverse() * sequence_truth_[i - 1].world_from_cam;
  }
  double LargestTrueStep() const {
    double largest = 0.0;
    for (size_t i = 0; i < sequence_truth_.size(); ++i) {
      if (const auto step = TrueStep(i)) largest = std::max(largest, step->translation().norm());
    }
    return largest;
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
  static inline std::vector<TimedPose>* other_truth_ = nullptr;
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
  ASSERT_TRUE(first.covariance.has_value());
  EXPECT_GT((*first.covariance)(5, 5), 1e-4);
}

// Most images show a room that is not in the map.
TEST_F(SegmentsTest, ALocalizedRunKeepsTheMapThatItWasFoundIn) {
  Append(*images_, 0, 19);
  Odometry first(QuickOptions(), camera_, LensDistortion());
  for (const RgbdImage& image : sequence_) first.Process(image);
  const size_t num_points = first.Finish().points.size();
  for (int visit = 0; visit < 2; ++visit) Append(*other_room_, 0, 29);
  Odometry odometry(QuickOptions(), camera_, LensDistortion());
  odometry.SetMap(*first.ShareMaps("first"));
  for (const RgbdImage& image : sequence_) odometry.Process(image);
  ASSERT_EQ(odometry.Finish().map_world, 2);
  const OdometryResult result = odometry.Finish(true);
  EXPECT_EQ(result.map_world, 0);
  EXPECT_GT(result.points.size(), num_points / 2);
  ASSERT_FALSE(result.keyframes.empty());
  EXPECT_LT(result.keyframes.back().timestamp, sequence_[20].timestamp);
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

TEST_F(SegmentsTest, TheOdometryPoseNeverJumps) {
  AppendVisits();
  for (const double latency : {0.0, 0.085}) {
    OdometryOptions options = QuickOptions();
    options.snapshots.latency = latency;
    std::vector<FrameResult> live;
    ASSERT_EQ(RunLive(options, &live).segments.size(), 3u);
    double largest_jump = 0.0;  // of the pose in the world
    for (size_t i = 1; i < live.size(); ++i) {
      const FrameResult &a = live[i - 1], &b = live[i];
      const Rigid3 step = b.cam_from_odometry * a.cam_from_odometry.Inverse();
      // Twice the largest true step, because predictions in the gaps are not measured.
      EXPECT_LT(step.translation().norm(), 2.0 * LargestTrueStep()) << i;
      const Rigid3 in_world = b.cam_from_world * a.cam_from_world.Inverse();
      largest_jump = std::max(largest_jump, in_world.translation().norm());
      const auto true_step = TrueStep(i);
      if (!IsEstimated(a.status) || !IsEstimated(b.status) || !true_step) continue;
      // Also where the maps are joined. Measured: 4 mm.
      EXPECT_LT((step.translation() - true_step->translation()).norm(), 0.01) << i;
    }
    EXPECT_GT(largest_jump, 4.0 * LargestTrueStep());
  }
}

TEST_F(SegmentsTest, PosesNameTheirWorldAndItsChanges) {
  AppendVisits();
  for (const double latency : {0.0, 0.085}) {
    OdometryOptions options = QuickOptions();
    options.snapshots.latency = latency;
    std::vector<FrameResult> live;
    const OdometryResult result = RunLive(options, &live);
    std::vector<int> worlds = {live[0].world};
    std::vector<Rigid3> final_from_live(live.size());  // from the world of a frame to the final one
    for (size_t i = 1; i < live.size(); ++i) {
      EXPECT_EQ(live[i].world_changed.has_value(), live[i].world != live[i - 1].world) << i;
      if (!live[i].world_changed) continue;
      worlds.push_back(live[i].world);
      EXPECT_EQ(live[i].world_changed->old_world, live[i - 1].world);
      const bool is_start = static_cast<int>(i) == result.segments[live[i].segment].first_frame;
      EXPECT_EQ(live[i].world_changed->new_from_old.has_value(), !is_start) << i;
      if (is_start) continue;
      for (size_t before = 0; before < i; ++before) {
        if (live[before].world != live[i].world_changed->old_world) continue;
        final_from_live[before] = *live[i].world_changed->new_from_old * final_from_live[before];
      }
    }
    EXPECT_THAT(worlds, ElementsAre(0, 1, 2, 0));
    for (size_t i = 0; i < live.size(); ++i) {
      const FrameResult& final_frame = result.frames[i];
      EXPECT_EQ(final_frame.world, result.segments[final_frame.segment].world);
      if (!IsEstimated(live[i].status)) continue;
      const Rigid3 expected = live[i].cam_from_world * final_from_live[i].Inverse();
      const Rigid3 difference = final_frame.cam_from_world * expected.Inverse();
      EXPECT_LT(difference.translation().norm(), 0.03) << i;
    }
    EXPECT_TRUE(result.frames[result.segments[1].first_frame].world_changed.has_value());
  }
}

TEST_F(SegmentsTest, AFrameThatBeginsAWorldHasNoCovariance) {
  AppendVisits();
  std::vector<FrameResult> live;
  const OdometryResult result = RunLive(QuickOptions(), &live);
  ASSERT_EQ(result.segments.size(), 3u);
  for (size_t i = 0; i < live.size(); ++i) {
    const bool begins = std::any_of(
        result.segments.begin(), result.segments.end(),
        [&](const Segment& segment) { return segment.first_frame == static_cast<int>(i); });
    EXPECT_EQ(live[i].covariance.has_value(), IsEstimated(live[i].status) && !begins) << i;
    if (!live[i].covariance) continue;
    EXPECT_GT(live[i].covariance->diagonal().minCoeff(), 0.0) << i;
  }
  // Segment 1 remains apart; the pose of the first frame of segment 2 is known by the join.
  EXPECT_FALSE(result.frames[result.segments[1].first_frame].covariance.has_value());
  EXPECT_TRUE(result.frames[result.segments[2].first_frame].covariance.has_value());
}

TEST_F(SegmentsTest, LivePosesAreRepeatable) {
  AppendVisits();
  std::vector<FrameResult> one, two, often;
  RunLive(QuickOptions(1), &one);
  RunLive(QuickOptions(2), &two);
  RunLive(QuickOptions(2), &often, 7);
  for (size_t i = 0; i < one.size(); ++i) {
    for (const FrameResult& other : {two[i], often[i]}) {
      EXPECT_EQ(one[i].cam_from_world.params, other.cam_from_world.params) << i;
      EXPECT_EQ(one[i].cam_from_odometry.params, other.cam_from_odometry.params) << i;
      EXPECT_EQ(one[i].world, other.world) << i;
      ASSERT_EQ(one[i].world_changed.has_value(), other.world_changed.has_value()) << i;
      if (!other.world_changed || !other.world_changed->new_from_old) continue;
      EXPECT_EQ(one[i].world_changed->new_from_old->params,
                other.world_changed->new_from_old->params);
    }
  }
}

TEST_F(SegmentsTest, CallbacksKnowTheWorldOfTheirPoses) {
  AppendVisits();
  for (const int threads : {1, 2}) {
    Odometry odometry(QuickOptions(threads), camera_, LensDistortion());
    std::vector<int> window_worlds;  // without repetitions
    odometry.SetWindowFactors([&](const WindowContext& window) {
      if (window_worlds.empty() || window_worlds.back() != window.world) {
        window_worlds.push_back(window.world);
      }
      return WindowFactors();
    });
    std::optional<int> world;
    odometry.SetPoseFactors([&](const FrameContext& frame) {
      world = frame.world;
      return std::vector<PoseFactor>();
    });
    for (const RgbdImage& image : sequence_) {
      world.reset();
      const FrameResult frame = odometry.Process(image);
      const bool begins = !frame.covariance && IsEstimated(frame.status);
      EXPECT_EQ(world.has_value(), image.id > 0) << image.id;
      if (!world || begins) continue;
      EXPECT_EQ(*world, frame.world) << image.id;
    }
    odometry.Finish();
    // Segment 1 has a window only if it gets a second keyframe.
    EXPECT_THAT(window_worlds, AnyOf(ElementsAre(0, 1, 2, 0), ElementsAre(0, 2, 0)));
  }
}

// A start that is discarded has the number of the one that replaces it, but another world.
TEST_F(SegmentsTest, AWorldThatReplacesAnotherIsAChange) {
  Append(*other_room_, 0, 0);  // nothing is tracked after it
  Append(*images_, 0, 39);
  std::vector<FrameResult> live;
  const OdometryResult result = RunLive(QuickOptions(), &live);
  ASSERT_EQ(result.segments.size(), 1u);
  for (size_t i = 0; i < live.size(); ++i) {
    EXPECT_EQ(live[i].world, 0);
    ASSERT_EQ(live[i].world_changed.has_value(),
              static_cast<int>(i) == result.segments[0].first_frame);
    if (!live[i].world_changed) continue;
    EXPECT_EQ(live[i].world_changed->old_world, 0);
    EXPECT_FALSE(live[i].world_changed->new_from_old.has_value());
  }
  EXPECT_EQ(result.frames[0].world, kNoSegment);
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
