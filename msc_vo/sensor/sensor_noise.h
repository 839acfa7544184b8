// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

namespace msc_vo {

/// Noise of the depth sensor and of the features: initial values, which NoiseEstimator refines
/// during a run. Chosen by measurement, see docs/lab/noise.md.
struct SensorNoiseOptions {
  /// Standard deviation of 1/z, 1/metres; constant for structured-light and stereo sensors, which
  /// measure disparity. The random part for a Kinect is 1.4e-3 (Khoshelham and Elberink 2012: 13 mm
  /// at 3 m); the larger, systematic part (registration, calibration) is common to all observations
  /// of a point and does not average out.
  double inverse_depth_sigma = 4e-3;
  /// Random part of the noise of 1/z between neighbouring pixels of a surface, 1/metres. Used to
  /// detect depth edges and outliers within one image, not for weights. Default: a Kinect at 3 m,
  /// including the rounding of disparities.
  double inverse_depth_noise = 2e-3;
  /// Standard deviation of a point on level 0, pixels; proportional to the scale of the level.
  double point_sigma = 0.5;
  /// Standard deviation of the distance of a segment's end point from the true line, pixels.
  double line_sigma = 0.25;
};

}  // namespace msc_vo
