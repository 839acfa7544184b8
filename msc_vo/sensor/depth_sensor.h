// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include "msc_vo/sensor/depth_noise.h"
#include "msc_vo/sensor/sensor_noise.h"

namespace msc_vo {

/// Principle of the depth sensor.
enum class DepthSensor {
  kAuto,             ///< chosen from the first depth images
  kStructuredLight,  ///< Kinect (first generation), Xtion; also exact depth
  kTimeOfFlight,     ///< Azure Kinect, Kinect (second generation)
  kStereo,           ///< active stereo: RealSense D400
  kLidar,            ///< telephones: few measurements, interpolated to an image
};

/// "auto", "structured-light", "tof", "stereo" or "lidar".
const char* ToString(DepthSensor sensor);

/// Model of the errors of a depth sensor.
struct DepthSensorModel {
  DepthSensor sensor = DepthSensor::kStructuredLight;
  DepthNoise noise = SensorNoiseOptions().inverse_depth_noise;
  /// Of a feature's depth, systematic errors included.
  DepthSigma sigma = {SensorNoiseOptions().inverse_depth_sigma};
  /// Features within this distance share one error of depth, pixels; 0: each has its own.
  double shared_radius = 0.0;
  bool has_flying_pixels = false;
  bool bleeds = false;  ///< near surfaces extend beyond their outline, see depth_bleeding.h

  /// Ratio of the total error of a feature's depth at inverse depth `w` (1/metres) to its random
  /// part. Surfaces are distinguished within one image by the random part.
  double SigmaPerNoise(double w) const { return sigma.At(w) / noise.At(w); }
};

/// Returns the model of `sensor` for images of `width` pixels; kAuto: that of structured light,
/// which has the sigmas of `options`. Chosen by measurement, see docs/lab/depth.md.
DepthSensorModel MakeDepthSensorModel(DepthSensor sensor, const SensorNoiseOptions& options,
                                      int width);

}  // namespace msc_vo
