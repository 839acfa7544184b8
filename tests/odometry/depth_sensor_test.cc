// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/sensor/depth_sensor.h"

#include "tests/support/rendered_images.h"
#include <gtest/gtest.h>

#include "msc_vo/features/frame_builder.h"

namespace msc_vo {
namespace {

SyntheticSequenceOptions SceneOptions(SceneKind scene, SyntheticDepth depth) {
  SyntheticSequenceOptions options;
  options.scene = scene;
  options.width = 320;
  options.height = 240;
  options.depth = depth;
  options.fps = 0.5;  // the first image of the room shows a single wall
  return options;
}

struct SensorCase {
  SyntheticDepth rendered;
  DepthSensor expected;
};

constexpr SensorCase kSensors[] = {
    {SyntheticDepth::kExact, DepthSensor::kStructuredLight},
    {SyntheticDepth::kStructuredLight, DepthSensor::kStructuredLight},
    {SyntheticDepth::kTimeOfFlight, DepthSensor::kTimeOfFlight},
    {SyntheticDepth::kStereo, DepthSensor::kStereo},
    {SyntheticDepth::kLidar, DepthSensor::kLidar},
};

TEST(DepthSensorChoice, FindsTheSensorInEveryScene) {
  for (const SceneKind scene : {SceneKind::kRoom, SceneKind::kCorridor, SceneKind::kBare,
                                SceneKind::kSlanted, SceneKind::kHouse}) {
    for (const SensorCase& sensor : kSensors) {
      const SyntheticSequenceOptions options = SceneOptions(scene, sensor.rendered);
      FrameBuilder builder({}, SyntheticSequence(options).camera(), LensDistortion());
      EXPECT_EQ(builder.depth_sensor(), DepthSensor::kAuto);
      for (int i = 0; i < 4 && builder.depth_sensor() == DepthSensor::kAuto; ++i) {
        builder.Build(RenderImages(options, i + 1)[i]);
      }
      EXPECT_STREQ(ToString(builder.depth_sensor()), ToString(sensor.expected))
          << static_cast<int>(scene);
    }
  }
}

OdometryResult ResultOf(DepthSensor sensor, const std::vector<RgbdImage>& images) {
  OdometryOptions options;
  options.features.depth_sensor = sensor;
  Odometry odometry(options, SyntheticSequence(RoomOptions()).camera(), LensDistortion());
  for (const RgbdImage& image : images) odometry.Process(image);
  return odometry.Finish();
}

TEST(DepthSensorChoice, LeavesStructuredLightAsItIs) {
  const std::vector<RgbdImage> images = RenderImages(RoomOptions(), 20);
  const OdometryResult chosen = ResultOf(DepthSensor::kAuto, images);
  EXPECT_EQ(chosen.depth_sensor, DepthSensor::kStructuredLight);
  ExpectSameBytes(chosen, ResultOf(DepthSensor::kStructuredLight, images));
}

TEST(DepthSensorChoice, IsOverriddenByTheOption) {
  const std::vector<RgbdImage> images = RenderImages(RoomOptions(), 2);
  EXPECT_EQ(ResultOf(DepthSensor::kLidar, images).depth_sensor, DepthSensor::kLidar);
}

TEST(DepthSensorChoice, WaitsForDepth) {
  std::vector<RgbdImage> images = RenderImages(RoomOptions(), 2);
  images[0].depth.setTo(0.0f);
  FrameBuilder builder({}, SyntheticSequence(RoomOptions()).camera(), LensDistortion());
  builder.Build(images[0]);
  EXPECT_EQ(builder.depth_sensor(), DepthSensor::kAuto);
  builder.Build(images[1]);
  EXPECT_EQ(builder.depth_sensor(), DepthSensor::kStructuredLight);
}

}  // namespace
}  // namespace msc_vo
