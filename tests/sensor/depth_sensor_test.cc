// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/sensor/depth_sensor.h"

#include <cmath>

#include <gtest/gtest.h>

namespace msc_vo {
namespace {

DepthSensorModel Model(DepthSensor sensor, int width = 640) {
  return MakeDepthSensorModel(sensor, SensorNoiseOptions(), width);
}

// Standard deviation of the depth of a pixel at depth z, metres.
double NoiseAt(const DepthSensorModel& model, double z) { return z * z * model.noise.At(1.0 / z); }

TEST(DepthSensor, StructuredLightIsWhatTheOptionsSay) {
  SensorNoiseOptions options;
  options.inverse_depth_noise = 0.0013;
  options.inverse_depth_sigma = 0.0052;
  for (const DepthSensor sensor : {DepthSensor::kStructuredLight, DepthSensor::kAuto}) {
    const DepthSensorModel model = MakeDepthSensorModel(sensor, options, 320);
    for (const double w : {0.1, 0.5, 3.0}) EXPECT_EQ(model.noise.At(w), 0.0013);
    EXPECT_EQ(model.SigmaPerNoise(0.7), options.inverse_depth_sigma / options.inverse_depth_noise);
    EXPECT_EQ(model.noise.correlation_length, 5.0);
    EXPECT_EQ(model.noise.edge_gap, 0);
    EXPECT_EQ(model.shared_radius, 0.0);
    EXPECT_FALSE(model.has_flying_pixels);
    EXPECT_FALSE(model.bleeds);
  }
}

// Disparity: the sigma of depth grows with the square of depth.
TEST(DepthSensor, SigmaOfStereoGrowsWithTheSquareOfDepth) {
  const DepthSensorModel model = Model(DepthSensor::kStereo);
  EXPECT_NEAR(NoiseAt(model, 4.0) / NoiseAt(model, 2.0), 4.0, 1e-12);
}

// Phase: twice the depth is at most twice the sigma.
TEST(DepthSensor, SigmaOfTimeOfFlightGrowsAtMostWithDepth) {
  for (const DepthSensor sensor : {DepthSensor::kTimeOfFlight, DepthSensor::kLidar}) {
    const DepthSensorModel model = Model(sensor);
    EXPECT_NEAR(NoiseAt(model, 3.0), model.noise.range + 3.0 * model.noise.proportional, 1e-12);
    const double growth = NoiseAt(model, 4.0) / NoiseAt(model, 2.0);
    EXPECT_GT(growth, 1.0);
    EXPECT_LT(growth, 2.0);
  }
}

TEST(DepthSensor, LengthsInPixelsFollowTheSizeOfTheImage) {
  const DepthSensorModel small = Model(DepthSensor::kStereo, 320);
  const DepthSensorModel large = Model(DepthSensor::kStereo, 1280);
  EXPECT_NEAR(large.noise.correlation_length, 4.0 * small.noise.correlation_length, 1e-12);
  EXPECT_NEAR(large.shared_radius, 4.0 * small.shared_radius, 1e-12);
}

TEST(DepthSensor, HasTheNamesOfTheOption) {
  EXPECT_STREQ(ToString(DepthSensor::kAuto), "auto");
  EXPECT_STREQ(ToString(DepthSensor::kStructuredLight), "structured-light");
  EXPECT_STREQ(ToString(DepthSensor::kTimeOfFlight), "tof");
  EXPECT_STREQ(ToString(DepthSensor::kStereo), "stereo");
  EXPECT_STREQ(ToString(DepthSensor::kLidar), "lidar");
}

}  // namespace
}  // namespace msc_vo
