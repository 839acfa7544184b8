// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/synthetic/scene/image_disturbances.h"

#include <cmath>

#include "msc_vo/geometry/angles.h"
#include "msc_vo/synthetic/scene/random.h"

namespace msc_vo {

void AddPhotonNoise(double light, uint64_t seed, uint64_t frame, RenderedImage* image) {
  constexpr double kPhotonsPerLevel = 4.0;  // detected per grey value in full light
  constexpr double kReadSigma = 1.2;        // grey values, before the gain
  Random random(seed, frame);
  const double photons_per_level = light * kPhotonsPerLevel;
  for (uint8_t& value : image->rgb) {
    if (value == 255) continue;
    const double photons = random.Poisson(photons_per_level * value);
    const double read = kReadSigma / light * random.Normal();
    value = ToGrayValue(static_cast<float>(photons / photons_per_level + read));
  }
}

void ApplyHuntingExposure(double seconds, RenderedImage* image) {
  constexpr double kAmplitude = 0.6, kPeriod = 1.9;  // of the gain around 1; seconds
  constexpr double kVignetting = 0.55;  // fraction of the light that is lost in the corners
  const double gain = 1.0 + kAmplitude * std::sin(2.0 * kPi * seconds / kPeriod);
  const double center_x = 0.5 * (image->width - 1), center_y = 0.5 * (image->height - 1);
  const double corner2 = center_x * center_x + center_y * center_y;
  size_t i = 0;
  for (int y = 0; y < image->height; ++y) {
    for (int x = 0; x < image->width; ++x) {
      const double dx = x - center_x, dy = y - center_y;
      const double light = 1.0 - kVignetting * (dx * dx + dy * dy) / corner2;
      const float factor = static_cast<float>(gain * light);
      for (int k = 0; k < 3; ++k, ++i) image->rgb[i] = ToGrayValue(factor * image->rgb[i]);
    }
  }
}

}  // namespace msc_vo
