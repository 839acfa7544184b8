// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <cmath>
#include <stdexcept>

#include "tests/support/custom_pose_factors.h"
#include "tests/support/message_matchers.h"
#include "tests/support/synthetic_frames.h"
#include "tests/support/synthetic_map.h"
#include <gmock/gmock.h>

#include "msc_vo/tracking/tracker.h"

namespace msc_vo {
namespace {

// The camera at the origin, turned to the right (positive angle, radians).
Rigid3 TurnedBy(double angle) {
  return Rigid3(Eigen::Quaterniond(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitY())),
                Eigen::Vector3d::Zero())
      .Inverse();
}

// A tracker of frames of a synthetic trajectory at 30 Hz. The world is camera 0.
class PoseFactorTrackingTest : public ::testing::Test {
 protected:
  static Rigid3 Truth(int index) {
    return SyntheticFrames::CamFromWorld(index) * SyntheticFrames::CamFromWorld(0).Inverse();
  }
  static int IndexAt(double timestamp) { return static_cast<int>(std::lround(30.0 * timestamp)); }

  // Wheel odometry that measures two percent too much.
  static std::vector<PoseFactor> WheelFactors(const FrameContext& context) {
    Rigid3 step =
        Truth(IndexAt(context.timestamp)) * Truth(IndexAt(context.last_timestamp)).Inverse();
    step = Rigid3(step.rotation(), 1.02 * step.translation());
    return {PriorFactor("wheel", step * context.last_cam_from_world, 0.005, 0.02)};
  }

  void Start(Tracker* tracker) {
    const std::shared_ptr<const Frame> first = world_.MakeFrame(0);
    ASSERT_EQ(tracker->Track(first, MapSnapshot()).status, TrackingStatus::kTracked);
    snapshot_ = MapOfOneKeyframe(first, Rigid3());
  }
  TrackedFrame Track(int index, Tracker* tracker) {
    return tracker->Track(world_.MakeFrame(index), snapshot_);
  }
  TrackedFrame TrackCovered(int index, Tracker* tracker) const {
    return tracker->Track(SyntheticFrames::MakeEmptyFrame(index), snapshot_);
  }

  SyntheticFrames world_{SyntheticFrames::Options()};
  MapSnapshot snapshot_;
};

TEST_F(PoseFactorTrackingTest, WheelsBridgeACoveredSecond) {
  Tracker with{TrackerOptions()}, without{TrackerOptions()};
  with.SetPoseFactors(WheelFactors);
  for (Tracker* tracker : {&with, &without}) {
    Start(tracker);
    for (int i = 1; i < 10; ++i) Track(i, tracker);
  }
  double error_with = 0.0, error_without = 0.0;
  for (int i = 10; i < 40; ++i) {
    const TrackedFrame bridged = TrackCovered(i, &with);
    EXPECT_EQ(bridged.status, TrackingStatus::kPredicted) << i;
    EXPECT_TRUE(bridged.pose.usable);
    EXPECT_THAT(bridged.pose.covariance(5, 5), testing::DoubleNear(4e-4, 1e-8));
    EXPECT_FALSE(bridged.keyframe.is_due());
    error_with = PositionError(bridged.cam_from_world, Truth(i));
    error_without = PositionError(TrackCovered(i, &without).cam_from_world, Truth(i));
  }
  EXPECT_LT(error_with, 0.02);
  EXPECT_GT(error_without, 5.0 * error_with);
  EXPECT_EQ(TrackCovered(40, &without).status, TrackingStatus::kLost);

  const TrackedFrame back = Track(41, &with);
  EXPECT_EQ(back.status, TrackingStatus::kTracked);
  EXPECT_FALSE(back.relocalized);
  EXPECT_LT(PositionError(back.cam_from_world, Truth(41)), 0.01);
}

TEST_F(PoseFactorTrackingTest, GravityTurnsThePose) {
  Tracker tracker{TrackerOptions()};
  Eigen::Vector3d in_cam = Eigen::Vector3d::Zero();
  double sigma = 1e-5;
  tracker.SetPoseFactors([&](const FrameContext& context) {
    const Eigen::Vector3d truth =
        Truth(IndexAt(context.timestamp)).rotation() * Eigen::Vector3d(0.0, 1.0, 0.0);
    in_cam = ExpSO3({0.002, 0.0, 0.001}) * truth;
    return std::vector<PoseFactor>{GravityFactor(in_cam, sigma)};
  });
  Start(&tracker);
  const auto error = [&](const TrackedFrame& tracked) {
    EXPECT_EQ(tracked.status, TrackingStatus::kTracked);
    return (tracked.cam_from_world.rotation() * Eigen::Vector3d::UnitY()).cross(in_cam).norm();
  };
  EXPECT_LT(error(Track(1, &tracker)), 1e-4);
  sigma = 1.0;
  EXPECT_GT(error(Track(2, &tracker)), 1e-3);
  // Gravity alone does not determine a pose: constant velocity bridges, for a while.
  EXPECT_FALSE(TrackCovered(3, &tracker).pose.usable);
  EXPECT_EQ(TrackCovered(30, &tracker).status, TrackingStatus::kLost);
}

TEST_F(PoseFactorTrackingTest, CallbackLearnsTheLastEstimatedFrame) {
  Tracker tracker{TrackerOptions()};
  std::vector<FrameContext> contexts;
  tracker.SetPoseFactors([&](const FrameContext& context) {
    contexts.push_back(context);
    return std::vector<PoseFactor>();
  });
  Start(&tracker);
  EXPECT_TRUE(contexts.empty());  // there is no last frame
  Track(1, &tracker);
  const TrackedFrame second = Track(2, &tracker);
  const TrackedFrame third = TrackCovered(3, &tracker);
  TrackCovered(4, &tracker);
  ASSERT_EQ(contexts.size(), 4u);
  EXPECT_EQ(contexts[0].last_cam_from_world.params, Rigid3().params);
  for (int i = 2; i < 4; ++i) {
    EXPECT_EQ(contexts[i].timestamp, (i + 1) / 30.0);
    EXPECT_EQ(contexts[i].last_timestamp, 2 / 30.0);
    EXPECT_LT(PositionError(contexts[i].last_cam_from_world, second.cam_from_world), 1e-12);
  }
  EXPECT_EQ(contexts[2].predicted_cam_from_world.params, third.cam_from_world.params);
}

// Two keyframes that share no landmarks: the camera is covered while it turns from one to the
// other. Relocalisation is off.
class TurnTest : public PoseFactorTrackingTest {
 protected:
  static constexpr double kLeft = -0.7, kRight = 0.7;  // radians

  TurnTest() { world_ = SyntheticFrames(ManyPoints()); }
  static SyntheticFrames::Options ManyPoints(unsigned seed = 1) {
    SyntheticFrames::Options options;
    options.num_points = 1000;
    options.seed = seed;
    return options;
  }
  static Tracker MakeTracker(bool with_factors) {
    TrackerOptions options;
    options.relocalizer.min_inliers = 100000;
    Tracker tracker(options);
    if (with_factors) {
      tracker.SetPoseFactors([](const FrameContext& context) {
        const double angle = IndexAt(context.timestamp) < 5 ? kLeft : kRight;
        return std::vector<PoseFactor>{PriorFactor("compass", TurnedBy(angle), 0.01, 0.02)};
      });
    }
    return tracker;
  }
  // Looks to the left at frame 0, is covered, and looks to the right from frame 10 on.
  void LookLeft(Tracker* tracker) {
    const std::shared_ptr<const Frame> first = world_.MakeFrame(0, TurnedBy(kLeft));
    tracker->Track(first, MapSnapshot());
    snapshot_ = MapOfOneKeyframe(first, TurnedBy(kLeft));
    for (int i = 1; i < 10; ++i) TrackCovered(i, tracker);
  }
};

TEST_F(TurnTest, SearchesTheMapAroundTheBridgedPose) {
  for (const bool with_factors : {true, false}) {
    Tracker tracker = MakeTracker(with_factors);
    LookLeft(&tracker);
    AddKeyframe(world_.MakeFrame(-1, TurnedBy(kRight)), TurnedBy(kRight), &snapshot_);
    // The keyframe in the tracker's memory is the first one.
    snapshot_.newest_keyframe = 0;
    const TrackedFrame seen = tracker.Track(world_.MakeFrame(10, TurnedBy(kRight)), snapshot_);
    EXPECT_EQ(seen.status, with_factors ? TrackingStatus::kTracked : TrackingStatus::kPredicted);
    if (!with_factors) continue;
    EXPECT_FALSE(seen.relocalized);
    EXPECT_LT(PositionError(seen.cam_from_world, TurnedBy(kRight)), 0.01);
  }
}

TEST_F(TurnTest, BeginsAnotherPartOfTheMapWhereItHasNone) {
  Tracker tracker = MakeTracker(true);
  LookLeft(&tracker);
  const TrackedFrame seen = tracker.Track(world_.MakeFrame(10, TurnedBy(kRight)), snapshot_);
  EXPECT_EQ(seen.status, TrackingStatus::kPredicted);  // not from the image
  EXPECT_TRUE(seen.keyframe.is_due());
  EXPECT_TRUE(seen.matches.points.empty());
  EXPECT_LT(PositionError(seen.cam_from_world, TurnedBy(kRight)), 1e-6);
  // Its features carry the next frame, even before they are landmarks.
  const TrackedFrame next = tracker.Track(world_.MakeFrame(11, TurnedBy(kRight)), snapshot_);
  EXPECT_TRUE(IsEstimated(next.status));
  EXPECT_LT(PositionError(next.cam_from_world, TurnedBy(kRight)), 0.01);
}

TEST_F(TurnTest, BeginsNoOtherPartWhereTheMapHasLandmarks) {
  Tracker tracker = MakeTracker(true);
  LookLeft(&tracker);
  AddKeyframe(world_.MakeFrame(-1, TurnedBy(kRight)), TurnedBy(kRight), &snapshot_);
  snapshot_.newest_keyframe = 0;
  // Something covers the lens that has features of its own.
  SyntheticFrames other(ManyPoints(7));
  const TrackedFrame seen = tracker.Track(other.MakeFrame(10, TurnedBy(kRight)), snapshot_);
  EXPECT_EQ(seen.status, TrackingStatus::kPredicted);
  EXPECT_FALSE(seen.keyframe.is_due());
}

TEST_F(PoseFactorTrackingTest, ThrowsErrorsOfTheCallbackAndContinues) {
  Tracker disturbed{TrackerOptions()}, other{TrackerOptions()};
  int num_calls = 0;
  disturbed.SetPoseFactors([&](const FrameContext& context) {
    ++num_calls;
    if (num_calls == 3) throw std::runtime_error("wheel: no data");
    if (num_calls == 4) return std::vector<PoseFactor>{{"wheel", nullptr, nullptr}};
    return WheelFactors(context);
  });
  other.SetPoseFactors(WheelFactors);
  Start(&disturbed);
  other.Track(snapshot_.map.FindKeyframe(0)->frame, MapSnapshot());
  for (int i = 1; i < 6; ++i) {
    const std::shared_ptr<const Frame> frame = world_.MakeFrame(i);
    if (i == 3) {
      EXPECT_THROW(disturbed.Track(frame, snapshot_), std::runtime_error);
      try {
        disturbed.Track(frame, snapshot_);
        FAIL() << "nothing was thrown";
      } catch (const std::invalid_argument& error) {
        EXPECT_THAT(error.what(), Names("'wheel'", "null"));
      }
    }
    const TrackedFrame a = disturbed.Track(frame, snapshot_), b = other.Track(frame, snapshot_);
    EXPECT_EQ(a.cam_from_world.params, b.cam_from_world.params) << i;
    EXPECT_EQ(a.status, b.status) << i;
  }
  EXPECT_EQ(num_calls, 7);
}

}  // namespace
}  // namespace msc_vo
