// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/synthetic/scene/hunting_exposure.h"

#include <cmath>
#include <stdexcept>

#include "msc_vo/geometry/angles.h"

namespace msc_vo {

bool HuntingExposureOptions::IsValid(std::string* error) const {
  if (!(amplitude >= 0.0 && amplitude < 1.0)) {
    *error = "hunting exposure: amplitude must be from 0 to less than 1";
  } else if (!(period > 0.0)) {
    *error = "hunting exposure: period must be positive";
  } else if (!(vignetting >= 0.0 && vignetting <= 1.0)) {
    *error = "hunting exposure: vignetting must be from 0 to 1";
  } else {
    return true;
  }
  return false;
}

void ApplyHuntingExposure(const HuntingExposureOptions& options, double seconds,
                          RenderedImage* image) {
  std::string error;
  if (!options.IsValid(&error)) throw std::invalid_argument("ApplyHuntingExposure: " + error);
  const double gain = 1.0 + options.amplitude * std::sin(2.0 * kPi * seconds / options.period);
  const double center_x = 0.5 * (image->width - 1), center_y = 0.5 * (image->height - 1);
  const double corner2 = center_x * center_x + center_y * center_y;
  size_t i = 0;
  for (int y = 0; y < image->height; ++y) {
    for (int x = 0; x < image->width; ++x) {
      const double dx = x - center_x, dy = y - center_y;
      const double light = 1.0 - options.vignetting * (dx * dx + dy * dy) / corner2;
      const float factor = static_cast<float>(gain * light);
      for (int k = 0; k < 3; ++k, ++i) image->rgb[i] = ToGrayValue(factor * image->rgb[i]);
    }
  }
}

}  // namespace msc_vo
