// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/self_calibration/readout_time_estimator.h"

#include <memory>
#include <optional>
#include <vector>

#include "tests/support/rolling_frames.h"
#include <gmock/gmock.h>

#include "msc_vo/self_calibration/keyframe_frames.h"
#include "msc_vo/self_calibration/readout_time_pair.h"

namespace msc_vo {
namespace {

constexpr double kReadoutTime = 0.026;  // seconds

// Adds a keyframe that observes landmark i with feature i.
KeyframeId AddKeyframe(RollingFrames* world, int index, Map* map) {
  const KeyframeId id =
      map->AddKeyframe(world->MakeFrame(index), RollingFrames::CamFromWorld(index));
  const bool is_first = map->points().size() == 0;
  std::vector<LandmarkId> landmarks;
  for (const auto& [landmark, point] : map->points()) landmarks.push_back(landmark);
  for (int i = 0; i < static_cast<int>(world->points().size()); ++i) {
    if (is_first) {
      map->Add<PointLandmark>(id, i, world->points()[i]);
    } else {
      map->Observe<PointLandmark>(landmarks[i], id, i);
    }
  }
  return id;
}

std::optional<ReadoutTimeEstimate> EstimateFirst(const Map& map, double start = 0.0) {
  return EstimateReadoutTime(*map.FindKeyframe(0), *map.FindKeyframe(1), start);
}

TEST(ReadoutTimePair, EstimatesTheReadoutTimeOfTwoKeyframes) {
  for (const double truth : {kReadoutTime, 0.0, -0.015}) {
    RollingFrames world(truth, 0.0);
    Map map;
    for (const int index : {0, 1}) AddKeyframe(&world, index, &map);
    EXPECT_NEAR(EstimateFirst(map)->readout_time, truth, 2e-4);
    EXPECT_NEAR(EstimateFirst(map, 0.03)->readout_time, truth, 2e-4);
  }
}

// Landmarks were estimated with another readout time and would bias the estimate.
TEST(ReadoutTimePair, IsIndependentOfLandmarks) {
  RollingFrames world(kReadoutTime, 0.0);
  Map map;
  for (const int index : {0, 1}) {
    map.AddKeyframe(world.MakeFrame(index), RollingFrames::CamFromWorld(index));
  }
  EXPECT_NEAR(EstimateFirst(map)->readout_time, kReadoutTime, 2e-4);
}

TEST(ReadoutTimePair, AccountsForTheCompensationOfKeyframes) {
  RollingFrames world(kReadoutTime, 0.0);
  Map map;
  for (const int index : {0, 1}) AddKeyframe(&world, index, &map);
  CompensateKeyframes(0.02, &map);
  EXPECT_EQ(map.FindKeyframe(1)->frame->readout_time, 0.02);
  EXPECT_NEAR(EstimateFirst(map)->readout_time, kReadoutTime, 5e-4);
}

TEST(ReadoutTimePair, ToleratesOutliers) {
  RollingFrames world(kReadoutTime, 0.3);
  Map map;
  AddKeyframe(&world, 0, &map);
  auto frame = world.MakeFrame(1);
  for (int i = 0; i < 15; ++i) frame->points[i].pixel.x() += 6.0;
  const KeyframeId id = AddKeyframe(&world, 1, &map);
  map.SetFrame(id, frame);
  EXPECT_NEAR(EstimateFirst(map)->readout_time, kReadoutTime, 2e-3);
}

TEST(ReadoutTimePair, HasNoInformationWithoutMotion) {
  RollingFrames world(kReadoutTime, 0.3);
  Map map;
  for (const int index : {0, 1}) AddKeyframe(&world, index, &map);
  const double information = EstimateFirst(map)->information;
  for (const KeyframeId id : {0, 1}) {
    auto frame = std::make_shared<Frame>(*map.FindKeyframe(id)->frame);
    frame->velocity = CameraVelocity();
    map.SetFrame(id, frame);
  }
  EXPECT_LT(EstimateFirst(map)->information, 1e-9 * information);
}

TEST(ReadoutTimePair, RequiresVelocitiesAndEnoughPoints) {
  RollingFrames world(kReadoutTime, 0.0);
  Map map;
  for (const int index : {0, 1}) AddKeyframe(&world, index, &map);
  const auto original = std::make_shared<Frame>(*map.FindKeyframe(0)->frame);
  auto frame = std::make_shared<Frame>(*original);
  frame->velocity.reset();
  map.SetFrame(0, frame);
  EXPECT_FALSE(EstimateFirst(map).has_value());
  frame = std::make_shared<Frame>(*original);
  for (size_t i = 29; i < frame->points.size(); ++i) frame->points[i].inverse_depth = 0.0;
  map.SetFrame(0, frame);
  EXPECT_FALSE(EstimateFirst(map).has_value());
}

// Readout time after so many keyframes of frames at the rate, Hz.
double EstimateOverKeyframes(double truth, const std::optional<double>& known, double rate = 30.0,
                             int num_keyframes = 12) {
  RollingFrames world(truth, 0.5);
  Map map;
  ReadoutTimeEstimator readout(known);
  for (int index = 0; index < num_keyframes; ++index) {
    const KeyframeId id = AddKeyframe(&world, index, &map);
    CompensateKeyframes(readout.readout_time(), &map);
    readout.Update(map, id, 1.0 / rate);
  }
  return readout.readout_time();
}

TEST(ReadoutTimeEstimator, EstimatesTheReadoutTimeOfARollingShutter) {
  EXPECT_NEAR(EstimateOverKeyframes(kReadoutTime, std::nullopt), kReadoutTime, 1e-3);
  EXPECT_NEAR(EstimateOverKeyframes(-kReadoutTime, std::nullopt), -kReadoutTime, 1e-3);
}

TEST(ReadoutTimeEstimator, KeepsAGlobalShutter) {
  EXPECT_EQ(EstimateOverKeyframes(0.0, std::nullopt), 0.0);
}

TEST(ReadoutTimeEstimator, KeepsAKnownReadoutTime) {
  EXPECT_EQ(EstimateOverKeyframes(kReadoutTime, 0.02), 0.02);
  EXPECT_EQ(EstimateOverKeyframes(kReadoutTime, 0.0), 0.0);
}

TEST(ReadoutTimeEstimator, IsBoundedByTheFrameInterval) {
  const double estimate = EstimateOverKeyframes(0.045, std::nullopt);
  EXPECT_LE(estimate, 1.0 / 30.0);
  EXPECT_GT(estimate, 0.032);
  for (const double rate : {5.0, 15.0, 28.0, 32.0}) {
    EXPECT_EQ(EstimateOverKeyframes(0.045, std::nullopt, rate), estimate) << rate;
  }
  EXPECT_LT(EstimateOverKeyframes(0.045, std::nullopt, 60.0, 80), 0.022);
}

// Keyframes of an earlier session, with the shutter of another camera, observe all landmarks.
TEST(ReadoutTimeEstimator, LeavesEarlierSessionsOut) {
  RollingFrames other(0.0, 0.5), world(kReadoutTime, 0.5);
  Map map;
  for (int index = 0; index < 3; ++index) AddKeyframe(&other, index, &map);
  map.BeginSession();
  ReadoutTimeEstimator readout(std::nullopt);
  for (int index = 3; index < 15; ++index) {
    readout.Update(map, AddKeyframe(&world, index, &map), 1.0 / 30.0);
  }
  EXPECT_NEAR(readout.readout_time(), kReadoutTime, 2e-3);
}

TEST(KeyframeRollingShutter, SkipsFramesWithoutVelocityAndSmallChanges) {
  RollingFrames world(kReadoutTime, 0.0);
  Map map;
  for (const int index : {0, 1}) AddKeyframe(&world, index, &map);
  auto frame = std::make_shared<Frame>(*map.FindKeyframe(0)->frame);
  frame->velocity.reset();
  map.SetFrame(0, frame);
  CompensateKeyframes(kReadoutTime, &map);
  EXPECT_EQ(map.FindKeyframe(0)->frame, frame);
  const auto compensated = map.FindKeyframe(1)->frame;
  EXPECT_EQ(compensated->readout_time, kReadoutTime);
  CompensateKeyframes(kReadoutTime + 0.0005, &map);
  EXPECT_EQ(map.FindKeyframe(1)->frame, compensated);
}

TEST(KeyframeRollingShutter, CompensatesAgainWithANewVelocity) {
  RollingFrames world(kReadoutTime, 0.0);
  Map map;
  AddKeyframe(&world, 0, &map);
  SetKeyframeVelocity(0, {1.1 * RollingFrames::Velocity(0).angular, {0.0, 0.0, 0.0}}, &map);
  CompensateKeyframes(kReadoutTime, &map);
  SetKeyframeVelocity(0, RollingFrames::Velocity(0), &map);
  const Frame& frame = *map.FindKeyframe(0)->frame;
  EXPECT_EQ(frame.readout_time, kReadoutTime);
  for (size_t i = 0; i < frame.points.size(); ++i) {
    const Eigen::Vector3d in_cam = RollingFrames::CamFromWorld(0) * world.points()[i];
    EXPECT_LT((frame.points[i].pixel - frame.camera.Project(in_cam)).norm(), 0.05);
  }
  SetKeyframeVelocity(7, RollingFrames::Velocity(0), &map);  // unknown keyframe: no effect
  EXPECT_EQ(map.keyframes().size(), 1u);
}

}  // namespace
}  // namespace msc_vo
