// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

namespace msc_vo {

// Noise of the depth sensor and of the features, from which every sigma of a frame follows.
struct SensorNoiseOptions {
  // Standard deviation of 1/z, 1/metres: a structured-light or stereo sensor measures disparity,
  // whose noise is constant. The random part of a Kinect's is 1.4e-3 (Khoshelham and Elberink 2012:
  // 13 mm at 3 m), but its larger part is systematic (registration, calibration) and common to all
  // views of a point, so that it does not average out. Where mapping/noise_estimator
  // starts from. Held at one value over a run, 1.4e-3 is the best for rendered rooms and twice as
  // bad as 8e-3 on fr1_rpy (docs/lab/depth.md).
  double inverse_depth_sigma = 4e-3;
  // Its random part alone, 1/metres: how much neighbouring pixels of one surface differ. Tells
  // depth edges and outliers along a line from noise, within one image, where the systematic part
  // does not show; it is no weight. That of a Kinect at 3 m, and what rounding of disparities adds
  // to it.
  double inverse_depth_noise = 2e-3;
  // Standard deviation of a point's pixel on level 0; it grows with the level's scale. Residuals of
  // solved windows: 0.25 px on rendered images, 0.5 to 0.6 px on real ones.
  double point_sigma = 0.5;
  // Standard deviation of the distance of a segment's end point to the true line, pixels. Where
  // mapping/noise_estimator starts from; it ends at 0.1 px on rendered images, at 0.45 and 0.65 px
  // on real ones.
  double line_sigma = 0.25;

  bool IsValid(std::string* error) const;
};

}  // namespace msc_vo
