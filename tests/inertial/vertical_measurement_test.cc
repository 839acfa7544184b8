// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/inertial/vertical_measurement.h"

#include <cmath>

#include <gtest/gtest.h>

#include "msc_vo/geometry/angles.h"
#include "msc_vo/synthetic/scene/synthetic_sequence.h"

namespace msc_vo {
namespace {

constexpr int kFramesPerKeyframe = 8;  // 0.27 seconds

// A hand-held camera in a room: readings of its accelerometer and its true poses at keyframes.
struct Recording {
  std::vector<TimedAcceleration> readings;
  std::vector<TimedPose> poses;

  explicit Recording(int num_frames = 900, double sigma = 0.05) {
    SyntheticSequenceOptions options;
    options.width = options.height = 32;
    options.accelerometer_sigma = sigma;
    const SyntheticSequence sequence(options);
    readings = sequence.AccelerometerReadings(num_frames);
    for (int i = 0; i < num_frames; i += kFramesPerKeyframe) poses.push_back(sequence.PoseAt(i));
  }
  // Degrees between a direction in the camera of a pose and the true vertical.
  double Error(size_t pose, const Eigen::Vector3d& up_in_cam) const {
    const Eigen::Vector3d up = poses[pose].world_from_cam.rotation() * up_in_cam.normalized();
    return std::acos(std::min(1.0, up.z())) * 180.0 / kPi;
  }
};

double RootMeanSquare(const std::vector<double>& values) {
  double squares = 0.0;
  for (const double value : values) squares += value * value;
  return std::sqrt(squares / static_cast<double>(values.size()));
}

TEST(MeasureVertical, SubtractsTheMotionOfTheCamera) {
  const Recording recording;
  std::vector<double> errors, errors_of_reading;
  for (const VerticalMeasurement& m : MeasureVertical(recording.readings, recording.poses, 1.0)) {
    errors.push_back(recording.Error(m.pose, m.up_in_cam));
    // The reading at the time of the keyframe: 100 readings and 30 frames a second.
    const size_t reading = m.pose * kFramesPerKeyframe * 100 / 30;
    errors_of_reading.push_back(recording.Error(m.pose, recording.readings[reading].acceleration));
    EXPECT_NEAR(m.up_in_cam.norm(), 9.81, 0.05);
  }
  ASSERT_GT(errors.size(), 90u);
  EXPECT_LT(RootMeanSquare(errors), 0.1);
  EXPECT_GT(RootMeanSquare(errors_of_reading), 10.0 * RootMeanSquare(errors));
}

TEST(MeasureVertical, MeasuresPosesWithNeighboursOnBothSides) {
  const Recording recording(200);
  const std::vector<VerticalMeasurement> all =
      MeasureVertical(recording.readings, recording.poses, 1.0);
  ASSERT_FALSE(all.empty());
  EXPECT_EQ(all.front().pose, 4u);  // 1.07 seconds after the first
  EXPECT_EQ(all.back().pose, recording.poses.size() - 5);
  // Neighbouring measurements, 0.27 seconds apart, share readings of 2.1 seconds.
  EXPECT_NEAR(all.front().independence, 0.25, 1e-6);
  // Poses every five seconds are too far apart.
  std::vector<TimedPose> rare;
  for (size_t i = 0; i < recording.poses.size(); i += 19) rare.push_back(recording.poses[i]);
  EXPECT_TRUE(MeasureVertical(recording.readings, rare, 1.0).empty());
  EXPECT_TRUE(MeasureVertical(recording.readings, {}, 1.0).empty());
}

TEST(MeasureVertical, LeavesOutPosesWithoutReadings) {
  const Recording recording(300);
  std::vector<TimedAcceleration> readings;
  for (const TimedAcceleration& reading : recording.readings) {
    if (reading.timestamp < 5.0 || reading.timestamp > 6.0) readings.push_back(reading);
  }
  std::vector<double> stamps;
  for (const VerticalMeasurement& m : MeasureVertical(readings, recording.poses, 1.0)) {
    stamps.push_back(recording.poses[m.pose].timestamp);
    EXPECT_LT(recording.Error(m.pose, m.up_in_cam), 1.0);
  }
  ASSERT_FALSE(stamps.empty());
  for (const double stamp : stamps) EXPECT_FALSE(stamp > 4.6 && stamp < 6.4) << stamp;
  EXPECT_LT(stamps.front(), 4.6);
  EXPECT_GT(stamps.back(), 6.4);
}

}  // namespace
}  // namespace msc_vo
