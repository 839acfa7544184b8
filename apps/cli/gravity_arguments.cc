// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/cli/gravity_arguments.h"

#include <stdexcept>
#include <utility>
#include <vector>

#include "apps/cli/argument_checks.h"
#include "msc_vo/datasets/accelerometer.h"
#include "msc_vo/geometry/angles.h"

namespace msc_vo {

void AddGravityArguments(CLI::App* command, GravityArguments* arguments) {
  CLI::Option* gravity = command->add_flag(
      "--gravity", arguments->enabled,
      "Tie roll and pitch to the accelerometer, accelerometer.txt in the folder of the sequence");
  const auto are_axes = [](const std::string& text) -> std::string {
    try {
      RotationFromAxes(text);
      return "";
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
  };
  command
      ->add_option(
          "--accelerometer-axes", arguments->axes,
          "Camera axes (x right, y down, z forward) of the accelerometer's x, y and z axis")
      ->check(are_axes)
      ->needs(gravity)
      ->capture_default_str();
  command
      ->add_option("--gravity-sigma", arguments->sigma,
                   "Standard deviation of the measured vertical, degrees; more for a biased sensor")
      ->check(NumberFrom(1e-6, 90.0))
      ->needs(gravity)
      ->capture_default_str();
}

std::unique_ptr<GravityFactors> MakeGravityFactors(const GravityArguments& arguments,
                                                   const SequenceIndex& sequence) {
  if (!arguments.enabled) return nullptr;
  const Eigen::Matrix3d rotation = RotationFromAxes(arguments.axes);
  std::vector<TimedAcceleration> readings = ReadAccelerometer(sequence);
  for (TimedAcceleration& reading : readings)
    reading.acceleration = rotation * reading.acceleration;
  GravityOptions options;
  options.min_sigma = DegreesToRadians(arguments.sigma);
  return std::make_unique<GravityFactors>(std::move(readings), options);
}

}  // namespace msc_vo
