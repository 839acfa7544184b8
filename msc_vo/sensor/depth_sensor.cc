// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/sensor/depth_sensor.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace msc_vo {

namespace {

// Width of the images that lengths in pixels refer to.
constexpr double kReferenceWidth = 640.0;

// Phase measurement: photon noise grows with distance, because light decreases; neighbouring pixels
// are independent. Azure Kinect: 17 mm at most within its range, systematic errors of 11 mm + 0.1
// %.
void MakeTimeOfFlight(double scale, DepthSensorModel* model) {
  model->noise = 0.0;
  model->noise.range = 0.002;
  model->noise.proportional = 0.0025;
  model->noise.correlation_length = 2.0 * scale;
  model->noise.edge_gap = std::max(1, static_cast<int>(std::lround(2.0 * scale)));
  model->sigma = {0.0, 0.0025, 0.01};
  model->has_flying_pixels = true;
}

// Disparity of a matching window: constant in 1/z. RealSense D400: 0.08 px at 50 mm baseline and a
// focal length of 480 to 640 px are 2.5e-3 to 3.3e-3 1/m.
void MakeStereo(double scale, DepthSensorModel* model) {
  model->noise = 0.003;
  model->noise.correlation_length = 9.0 * scale;
  model->sigma = {0.0045};
  model->shared_radius = 8.0 * scale;
  model->bleeds = true;
}

// Some ten thousand pulses, interpolated to an image: little noise, wide edges.
void MakeLidar(double scale, DepthSensorModel* model) {
  model->noise = 0.0;
  model->noise.range = 0.005;
  model->noise.proportional = 0.002;
  model->noise.correlation_length = 12.0 * scale;
  model->noise.edge_gap = std::max(1, static_cast<int>(std::lround(4.0 * scale)));
  model->sigma = {0.0, 0.003, 0.01};
  model->shared_radius = 10.0 * scale;
  model->has_flying_pixels = true;
}

}  // namespace

const char* ToString(DepthSensor sensor) {
  switch (sensor) {
    case DepthSensor::kAuto:
      return "auto";
    case DepthSensor::kStructuredLight:
      return "structured-light";
    case DepthSensor::kTimeOfFlight:
      return "tof";
    case DepthSensor::kStereo:
      return "stereo";
    case DepthSensor::kLidar:
      return "lidar";
  }
  return "unknown";
}

DepthSensorModel MakeDepthSensorModel(DepthSensor sensor, const SensorNoiseOptions& options,
                                      int width) {
  DepthSensorModel model;
  model.sensor = sensor == DepthSensor::kAuto ? DepthSensor::kStructuredLight : sensor;
  model.noise = options.inverse_depth_noise;
  model.sigma = {options.inverse_depth_sigma};
  const double scale = width / kReferenceWidth;
  if (sensor == DepthSensor::kTimeOfFlight) MakeTimeOfFlight(scale, &model);
  if (sensor == DepthSensor::kStereo) MakeStereo(scale, &model);
  if (sensor == DepthSensor::kLidar) MakeLidar(scale, &model);
  const auto env = [](const char* name, double value) {
    const char* e = std::getenv(name);
    return e ? std::atof(e) : value;
  };  // XXX
  if (sensor == DepthSensor::kTimeOfFlight || sensor == DepthSensor::kStereo ||
      sensor == DepthSensor::kLidar) {  // XXX
    model.sigma.disparity = env("X_SDIS", model.sigma.disparity);
    model.sigma.range = env("X_SRNG", model.sigma.range);
    model.sigma.proportional = env("X_SPRO", model.sigma.proportional);  // XXX
    model.shared_radius = env("X_SHR", model.shared_radius);             // XXX
    model.noise.correlation_length = env("X_COR", model.noise.correlation_length);
    model.noise.edge_gap = env("X_GAP", model.noise.edge_gap);  // XXX
    model.noise.disparity = env("X_DIS", model.noise.disparity);
    model.noise.range = env("X_RNG", model.noise.range);
    model.noise.proportional = env("X_PRO", model.noise.proportional);  // XXX
    model.has_flying_pixels = env("X_FLY", model.has_flying_pixels);
    model.bleeds = env("X_BLD", model.bleeds);
  }                                                                         // XXX
  return model;
}

}  // namespace msc_vo
