// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/tracking/tracker.h"

#include "tests/tracking/tracker_fixture.h"
#include <gmock/gmock.h>

#include "msc_vo/frame/feature_counts.h"

namespace msc_vo {
namespace {

TEST_F(TrackerTest, EstimatesThePoseOfEveryFrame) {
  Start({});
  for (int i = 1; i < 30; ++i) {
    const TrackedFrame tracked = Track(i);
    ASSERT_EQ(tracked.status, TrackingStatus::kTracked) << i;
    // Landmarks of a single keyframe have the noise of its features: 0.5 px and 1e-3 1/m.
    EXPECT_LT(PositionError(tracked.cam_from_world, Truth(i)), 0.01) << i;
    EXPECT_LT(RotationError(tracked.cam_from_world, Truth(i)), 0.003) << i;
    EXPECT_GT(tracked.pose.num_inliers.points, 100) << i;
  }
}

TEST_F(TrackerTest, EstimatesTheVelocityAtTheFirstKeyframe) {
  Start({});
  const TrackedFrame tracked = Track(1);
  ASSERT_TRUE(tracked.previous_velocity.has_value());
  const Eigen::Vector3d metres = tracked.previous_velocity->linear / 30.0;
  EXPECT_TRUE(metres.isApprox(tracked.cam_from_world.translation(), 1e-6));
  EXPECT_FALSE(Track(2).previous_velocity.has_value());
}

TEST_F(TrackerTest, RequestsAKeyframeToCompensateTheFirstOne) {
  Start({});
  snapshot_.readout_time = 0.026;
  const TrackedFrame second = Track(1);
  EXPECT_TRUE(second.keyframe.is_due());
  EXPECT_EQ(second.frame->readout_time, 0.0);  // like the map
  EXPECT_TRUE(second.frame->velocity.has_value());
  EXPECT_FALSE(Track(2).keyframe.is_due());  // the new map is not available yet
  // The mapper compensates the first keyframe as soon as its velocity is known.
  auto first = std::make_shared<Frame>(*snapshot_.map.FindKeyframe(0)->frame);
  first->velocity = CameraVelocity();
  snapshot_.map.SetFrame(0, first);
  EXPECT_EQ(Track(3).frame->readout_time, 0.026);
}

// The mapper has moved the keyframe of the last frame; the pose is bridged from there.
TEST_F(TrackerTest, TakesOverThePoseOfTheKeyframeWithTheProposedId) {
  const std::shared_ptr<const Frame> first =
      SyntheticFrames(SyntheticFrames::Options()).MakeFrame(0);
  const Rigid3 moved(Eigen::Quaterniond::Identity(), {0.0, 0.5, 0.0});
  auto retimed = std::make_shared<Frame>(*first);
  retimed->timestamp += 1.0;
  for (const bool is_same : {true, false}) {
    Tracker tracker{TrackerOptions()};
    const KeyframeId id = tracker.Track(first, MapSnapshot()).keyframe.id;
    // The time stamps say the opposite of the ids.
    const MapSnapshot snapshot =
        is_same ? MapOfOneKeyframe(retimed, moved, id) : MapOfOneKeyframe(first, moved, id + 1);
    const TrackedFrame bridged = tracker.Track(SyntheticFrames::MakeEmptyFrame(1), snapshot);
    EXPECT_EQ(bridged.cam_from_world.params, (is_same ? moved : Rigid3()).params) << is_same;
  }
}

TEST_F(TrackerTest, NumbersItsKeyframes) {
  Start({});
  KeyframeId last = 0;
  for (int i = 1; i < 60; ++i) {
    const TrackedFrame tracked = Track(i);
    if (!tracked.keyframe.is_due()) continue;
    EXPECT_EQ(tracked.keyframe.id, ++last) << i;
  }
  EXPECT_GT(last, 1);
}

TEST_F(TrackerTest, TracksFifteenLinesAndTenPoints) {
  SyntheticFrames::Options options;
  options.num_points = 14;
  options.num_lines = 24;
  Start(options);
  for (int i = 1; i < 20; ++i) {
    const TrackedFrame tracked = Track(i);
    ASSERT_TRUE(tracked.status == TrackingStatus::kTracked) << i << ToString(tracked.status);
    EXPECT_LT(PositionError(tracked.cam_from_world, Truth(i)), 0.03) << i;
  }
}

TEST_F(TrackerTest, TracksLinesWithoutPoints) {
  SyntheticFrames::Options options;
  options.num_points = 0;
  options.num_lines = 40;
  Start(options);
  for (int i = 1; i < 20; ++i) {
    const TrackedFrame tracked = Track(i);
    ASSERT_TRUE(IsEstimated(tracked.status)) << i << ToString(tracked.status);
    EXPECT_LT(PositionError(tracked.cam_from_world, Truth(i)), 0.03) << i;
  }
}

TEST_F(TrackerTest, TracksSevenLinesWithoutPoints) {
  SyntheticFrames::Options options;
  options.num_points = 0;
  options.num_lines = 12;
  Start(options);
  ASSERT_LT(NumWithDepth(*snapshot_.map.FindKeyframe(0)->frame), 10);
  for (int i = 1; i < 10; ++i) {
    const TrackedFrame tracked = Track(i);
    ASSERT_TRUE(IsEstimated(tracked.status)) << i << ToString(tracked.status);
    EXPECT_LT(PositionError(tracked.cam_from_world, Truth(i)), 0.05) << i;
  }
}

TEST(CanBeginMap, NeedsManyFeaturesOrLinesInTwoDirections) {
  SyntheticFrames::Options options;
  options.num_points = 0;
  options.num_lines = 12;
  Frame frame = *SyntheticFrames(options).MakeFrame(0);
  EXPECT_TRUE(CanBeginMap(frame, 20));
  // One direction does not determine a position along it.
  Frame parallel = frame;
  parallel.lines.assign(8, frame.lines.front());
  EXPECT_FALSE(CanBeginMap(parallel, 20));
  EXPECT_TRUE(CanBeginMap(parallel, 8));
  frame.lines.resize(4);
  EXPECT_FALSE(CanBeginMap(frame, 20));
}

TEST_F(TrackerTest, PredictsCoveredFramesAndResumes) {
  Start({});
  for (int i = 1; i < 10; ++i) Track(i);
  for (int i = 10; i < 15; ++i) {
    const TrackedFrame tracked = tracker_.Track(SyntheticFrames::MakeEmptyFrame(i), snapshot_);
    EXPECT_EQ(tracked.status, TrackingStatus::kPredicted) << i;
    EXPECT_FALSE(tracked.keyframe.is_due());
    // Constant velocity for a sixth of a second.
    EXPECT_LT(PositionError(tracked.cam_from_world, Truth(i)), 0.03) << i;
  }
  const TrackedFrame back = Track(15);
  EXPECT_EQ(back.status, TrackingStatus::kTracked);
  EXPECT_LT(PositionError(back.cam_from_world, Truth(15)), 0.01);
}

TEST_F(TrackerTest, ReportsLossAndRelocalizes) {
  Start({});
  for (int i = 1; i < 5; ++i) Track(i);
  TrackedFrame tracked;
  for (int i = 5; i < 40; ++i)
    tracked = tracker_.Track(SyntheticFrames::MakeEmptyFrame(i), snapshot_);
  EXPECT_EQ(tracked.status, TrackingStatus::kLost);
  EXPECT_TRUE(tracked.cam_from_world.params.allFinite());
  // The camera reappears far from the pose that constant velocity predicts.
  tracked = Track(90);
  EXPECT_EQ(tracked.status, TrackingStatus::kTracked);
  EXPECT_LT(PositionError(tracked.cam_from_world, Truth(90)), 0.03);
}

TEST_F(TrackerTest, BeginsASegmentWhenTheMapIsNotFoundForASecond) {
  Start({});
  for (int i = 1; i < 5; ++i) Track(i);
  SyntheticFrames::Options elsewhere;
  elsewhere.seed = 2;
  SyntheticFrames other(elsewhere);
  TrackedFrame tracked;
  int first = 5;
  for (; first < 60; ++first) {
    tracked = tracker_.Track(other.MakeFrame(first), snapshot_);
    if (tracked.keyframe.segment_start != SegmentStart::kNone) break;
    EXPECT_FALSE(tracked.keyframe.is_due());
  }
  EXPECT_NEAR(first, 4 + 30, 1);
  EXPECT_EQ(tracked.keyframe.segment_start, SegmentStart::kAfterLoss);
  EXPECT_EQ(tracked.status, TrackingStatus::kTracked);
  EXPECT_TRUE(tracked.keyframe.is_due());
  EXPECT_EQ(tracked.reference, kNoId);
  // The map begins where the camera was seen last.
  EXPECT_LT(PositionError(tracked.cam_from_world, Truth(4)), 0.01);

  const Rigid3 world_from_first = tracked.cam_from_world.Inverse();
  snapshot_ = MapOfOneKeyframe(tracked.frame, tracked.cam_from_world, tracked.keyframe.id);
  for (int i = first + 1; i < first + 10; ++i) {
    tracked = tracker_.Track(other.MakeFrame(i), snapshot_);
    EXPECT_EQ(tracked.status, TrackingStatus::kTracked) << i;
    const Rigid3 truth = SyntheticFrames::CamFromWorld(i) *
                         SyntheticFrames::CamFromWorld(first).Inverse() *
                         world_from_first.Inverse();
    EXPECT_LT(PositionError(tracked.cam_from_world, truth), 0.01) << i;
  }
}

TEST_F(TrackerTest, ReplacesAMapThatNothingWasTrackedIn) {
  Start({});
  SyntheticFrames::Options elsewhere;
  elsewhere.seed = 2;
  SyntheticFrames other(elsewhere);
  for (int i = 1; i < 16; ++i) {
    EXPECT_EQ(tracker_.Track(other.MakeFrame(i), snapshot_).keyframe.segment_start,
              SegmentStart::kNone);
  }
  // max_prediction has passed.
  EXPECT_EQ(tracker_.Track(other.MakeFrame(16), snapshot_).keyframe.segment_start,
            SegmentStart::kReplacing);
}

// The frame as an image of a camera with the rate, Hz.
std::shared_ptr<const Frame> AtRate(double rate, const std::shared_ptr<const Frame>& frame) {
  auto at_rate = std::make_shared<Frame>(*frame);
  at_rate->timestamp *= 30.0 / rate;
  return at_rate;
}

TEST_F(TrackerTest, GivesUpALargeMapAfterTheSameTimeAtAnyRate) {
  SyntheticFrames::Options elsewhere;
  elsewhere.seed = 2;
  SyntheticFrames other(elsewhere);
  world_ = std::make_unique<SyntheticFrames>(SyntheticFrames::Options());
  const std::shared_ptr<const Frame> first = world_->MakeFrame(0);
  snapshot_ = MapOfOneKeyframe(first, Rigid3());
  // 135 keyframes are tried once in 1.5 s.
  for (int i = 1; i < 135; ++i) snapshot_.map.AddKeyframe(first, Rigid3());
  for (const double rate : {5.0, 15.0, 30.0, 60.0}) {
    Tracker tracker{TrackerOptions()};
    tracker.Track(first, MapSnapshot());
    EXPECT_EQ(tracker.Track(AtRate(rate, world_->MakeFrame(1)), snapshot_).status,
              TrackingStatus::kTracked);
    int i = 2;
    while (i < 300 &&
           tracker.Track(AtRate(rate, other.MakeFrame(i)), snapshot_).keyframe.segment_start ==
               SegmentStart::kNone) {
      ++i;
    }
    EXPECT_NEAR((i - 1) / rate, 1.5, 0.4) << rate;
  }
}

// The frame as of a camera that looks at a wall at so many metres.
std::shared_ptr<const Frame> AtWall(const std::shared_ptr<const Frame>& frame, double distance) {
  auto at_wall = std::make_shared<Frame>(*frame);
  const auto w = static_cast<float>(1.0 / distance);
  at_wall->depth_ranges.cells.assign(DepthRanges::kColumns * DepthRanges::kRows, {w, w});
  return at_wall;
}

TEST_F(TrackerTest, DoesNotTrustAPoseAfterAGapThatDepthImagesContradict) {
  for (const double distance : {3.0, 9.0}) {
    Tracker tracker{TrackerOptions()};
    world_ = std::make_unique<SyntheticFrames>(SyntheticFrames::Options());
    const std::shared_ptr<const Frame> first = AtWall(world_->MakeFrame(0), 3.0);
    tracker.Track(first, MapSnapshot());
    snapshot_ = MapOfOneKeyframe(first, Rigid3());
    const auto status_of = [&](int index) {
      return tracker.Track(AtWall(world_->MakeFrame(index), distance), snapshot_).status;
    };
    EXPECT_EQ(status_of(1), TrackingStatus::kTracked);
    const bool looks_through_the_wall = distance > 3.0;
    const TrackingStatus expected =
        looks_through_the_wall ? TrackingStatus::kWeak : TrackingStatus::kTracked;
    tracker.Track(SyntheticFrames::MakeEmptyFrame(2), snapshot_);
    EXPECT_EQ(status_of(3), expected);
    EXPECT_EQ(status_of(4), expected);
  }
}

// The frame with every eighth of its points and without lines.
std::shared_ptr<const Frame> Thinned(const std::shared_ptr<const Frame>& frame) {
  auto thinned = std::make_shared<Frame>(*frame);
  thinned->points.clear();
  for (size_t i = 0; i < frame->points.size(); i += 8) {
    thinned->points.push_back(frame->points[i]);
  }
  thinned->lines.clear();
  thinned->grid = FeatureGrid(thinned->camera, thinned->points);
  return thinned;
}

// The frame with other points in place of three quarters of its own.
std::shared_ptr<const Frame> WithOthers(const std::shared_ptr<const Frame>& frame) {
  auto others = std::make_shared<Frame>(*frame);
  for (size_t i = 0; i < others->points.size(); ++i) {
    if (i % 4 == 0) continue;
    for (uint8_t& byte : others->points[i].descriptor) byte = ~byte;
  }
  return others;
}

double TranslationSigma(const TrackedFrame& tracked) {
  return std::sqrt(tracked.pose.covariance.diagonal().tail<3>().maxCoeff());
}

// What follows a guess continues it. Keyframes there could join two places in the map.
TEST_F(TrackerTest, DoesNotTrustPosesThatFollowAWeakOneAfterAGap) {
  Start({});
  const double sigma = TranslationSigma(Track(1));
  const double thinned_sigma =
      TranslationSigma(tracker_.Track(Thinned(world_->MakeFrame(2)), snapshot_));
  ASSERT_GT(thinned_sigma, 1.5 * sigma);
  TrackerOptions options;
  options.weak_translation_sigma = std::sqrt(sigma * thinned_sigma);
  for (const bool has_gap : {true, false}) {
    tracker_ = Tracker(options);
    Start({});
    EXPECT_EQ(Track(1).status, TrackingStatus::kTracked);
    // An image that is left out is no gap.
    if (has_gap) tracker_.Track(SyntheticFrames::MakeEmptyFrame(2), snapshot_);
    const TrackedFrame weak = tracker_.Track(Thinned(world_->MakeFrame(3)), snapshot_);
    EXPECT_EQ(weak.status, TrackingStatus::kWeak);
    EXPECT_EQ(Track(4).status, has_gap ? TrackingStatus::kWeak : TrackingStatus::kTracked);
    const TrackedFrame elsewhere = tracker_.Track(WithOthers(world_->MakeFrame(5)), snapshot_);
    EXPECT_EQ(elsewhere.keyframe.is_due(), !has_gap);
  }
}

TEST_F(TrackerTest, WaitsForAFirstFrameWithFeatures) {
  world_ = std::make_unique<SyntheticFrames>(SyntheticFrames::Options());
  const TrackedFrame empty = tracker_.Track(SyntheticFrames::MakeEmptyFrame(0), MapSnapshot());
  EXPECT_EQ(empty.status, TrackingStatus::kLost);
  EXPECT_FALSE(empty.keyframe.is_due());
  const TrackedFrame first = tracker_.Track(world_->MakeFrame(1), MapSnapshot());
  EXPECT_EQ(first.status, TrackingStatus::kTracked);
  EXPECT_TRUE(first.keyframe.is_due());
}

}  // namespace
}  // namespace msc_vo
