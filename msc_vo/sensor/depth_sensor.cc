// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/sensor/depth_sensor.h"

#include <algorithm>
#include <cmath>

#include "msc_vo/camera/image_scale.h"
#include "msc_vo/text/enum_names.h"

namespace msc_vo {

namespace {

// A sensor that measures distance, not disparity. Lengths in pixels.
void MakeRanging(const DepthSigma& noise, double correlation_length, double edge_gap,
                 DepthSensorModel* model) {
  static_cast<DepthSigma&>(model->noise) = noise;
  model->noise.correlation_length = correlation_length;
  model->noise.edge_gap = std::max(1, static_cast<int>(std::lround(edge_gap)));
  model->has_flying_pixels = true;
}

// Phase measurement: photon noise grows with distance, because light decreases; neighbouring pixels
// are independent. Azure Kinect: 17 mm at most within its range, systematic errors of 11 mm +
// 0.1 %.
void MakeTimeOfFlight(double scale, DepthSensorModel* model) {
  MakeRanging({0.0, 0.0025, 0.002}, 2.0 * scale, 2.0 * scale, model);
  model->sigma = {0.0, 0.0025, 0.01};
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
  MakeRanging({0.0, 0.002, 0.005}, 12.0 * scale, 4.0 * scale, model);
  model->sigma = {0.0, 0.003, 0.01};
  model->shared_radius = 10.0 * scale;
}

}  // namespace

const char* ToString(DepthSensor sensor) {
  return EnumName<DepthSensor::kLidar>(sensor,
                                       {"auto", "structured-light", "tof", "stereo", "lidar"});
}

DepthSensorModel MakeDepthSensorModel(DepthSensor sensor, const SensorNoiseOptions& options,
                                      int width) {
  DepthSensorModel model;
  model.sensor = sensor == DepthSensor::kAuto ? DepthSensor::kStructuredLight : sensor;
  model.noise = options.inverse_depth_noise;
  model.sigma = {options.inverse_depth_sigma};
  const double scale = ImageScale(width);
  if (sensor == DepthSensor::kTimeOfFlight) MakeTimeOfFlight(scale, &model);
  if (sensor == DepthSensor::kStereo) MakeStereo(scale, &model);
  if (sensor == DepthSensor::kLidar) MakeLidar(scale, &model);
  return model;
}

}  // namespace msc_vo
