// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/tracking/frame_compensation.h"

#include <gtest/gtest.h>

namespace msc_vo {
namespace {

constexpr double kReadoutTime = 0.026;  // seconds
const CameraVelocity kVelocity{{1.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};

std::shared_ptr<const Frame> MakeFrame(const std::optional<CameraVelocity>& velocity) {
  auto frame = std::make_shared<Frame>();
  frame->velocity = velocity;
  frame->points.resize(1);
  frame->points[0].pixel = {320.0, 470.0};
  return frame;
}

MapSnapshot MakeSnapshot(std::initializer_list<std::optional<CameraVelocity>> velocities) {
  MapSnapshot snapshot;
  snapshot.readout_time = kReadoutTime;
  for (const auto& velocity : velocities) {
    snapshot.newest_keyframe = snapshot.map.AddKeyframe(MakeFrame(velocity), Rigid3());
  }
  return snapshot;
}

TEST(FrameCompensation, AwaitsTheVelocityOfASingleKeyframe) {
  EXPECT_TRUE(AwaitsCompensation(MakeSnapshot({std::nullopt})));
  EXPECT_FALSE(AwaitsCompensation(MakeSnapshot({kVelocity})));
  EXPECT_FALSE(AwaitsCompensation(MakeSnapshot({std::nullopt, std::nullopt})));
  EXPECT_FALSE(AwaitsCompensation(MakeSnapshot({})));
}

TEST(FrameCompensation, UsesTheReadoutTimeOfTheMap) {
  EXPECT_EQ(CompensationReadoutTime(MakeSnapshot({std::nullopt})), 0.0);
  EXPECT_EQ(CompensationReadoutTime(MakeSnapshot({kVelocity})), kReadoutTime);
  EXPECT_EQ(CompensationReadoutTime(MakeSnapshot({kVelocity, std::nullopt})), kReadoutTime);
}

TEST(FrameCompensation, ReturnsTheSameFrameWithoutVelocity) {
  const std::shared_ptr<const Frame> frame = MakeFrame(std::nullopt);
  EXPECT_EQ(CompensateFrame(frame, std::nullopt, kReadoutTime), frame);
}

TEST(FrameCompensation, CompensatesACopyWithTheVelocity) {
  const std::shared_ptr<const Frame> frame = MakeFrame(std::nullopt);
  const Eigen::Vector2d raw = frame->points[0].pixel;
  const auto compensated = CompensateFrame(frame, kVelocity, kReadoutTime);
  EXPECT_EQ(compensated->readout_time, kReadoutTime);
  ASSERT_TRUE(compensated->velocity.has_value());
  EXPECT_EQ(compensated->velocity->angular, kVelocity.angular);
  // Rotation about x for nearly half of the readout time: about 6.5 pixels and more off the centre.
  EXPECT_GT((compensated->points[0].pixel - raw).norm(), 6.0);
  EXPECT_EQ(frame->points[0].pixel, raw);
  EXPECT_FALSE(frame->velocity.has_value());
}

}  // namespace
}  // namespace msc_vo
