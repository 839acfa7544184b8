// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <map>
#include <string>

#include "msc_vo/camera/sensor_correction.h"

namespace msc_vo {

// The parameter of a SensorCorrection that each value of a calibration has its sigma from.
inline std::map<std::string, SensorCorrection::Index> ParametersOfCalibration() {
  using S = SensorCorrection;
  return {{"fx", S::kFocalLength},
          {"fy", S::kFocalLength},
          {"cx", S::kCenterX},
          {"cy", S::kCenterY},
          {"k1", S::kK1},
          {"k2", S::kK2},
          {"depth_cx", S::kDepthX},
          {"depth_cy", S::kDepthY},
          {"depth_fx", S::kDepthFocalLength},
          {"depth_roll", S::kDepthRoll},
          {"depth_x", S::kDepthParallaxX},
          {"depth_y", S::kDepthParallaxY}};
}

}  // namespace msc_vo
