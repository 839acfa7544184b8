// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/sensor/sensor_noise.h"

namespace msc_vo {

bool SensorNoiseOptions::IsValid(std::string* error) const {
  if (!(inverse_depth_sigma > 0.0)) {
    *error = "noise.inverse_depth_sigma must be positive (1/metres)";
  } else if (!(inverse_depth_noise > 0.0)) {
    *error = "noise.inverse_depth_noise must be positive (1/metres)";
  } else if (!(point_sigma > 0.0)) {
    *error = "noise.point_sigma must be positive (pixels)";
  } else if (!(line_sigma > 0.0)) {
    *error = "noise.line_sigma must be positive (pixels)";
  } else {
    return true;
  }
  return false;
}

}  // namespace msc_vo
