// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

namespace msc_vo {

// Noise of the depth sensor and of the features, from which every sigma of a frame follows.
struct SensorNoiseOptions {
  // Standard deviation of 1/z, 1/metres: a structured-light or stereo sensor measures disparity,
  // whose noise is constant. 1.425e-3 is the Kinect's (Khoshelham and Elberink 2012: 1.4 mm at 1 m,
  // 13 mm at 3 m).
  double inverse_depth_sigma = 1.425e-3;
  // Standard deviation of a point's pixel on level 0; it grows with the level's scale.
  double point_sigma = 1.0;
  // Standard deviation of the distance of a segment's end point to the true line, pixels.
  double line_sigma = 1.0;

  bool IsValid(std::string* error) const;
};

}  // namespace msc_vo
