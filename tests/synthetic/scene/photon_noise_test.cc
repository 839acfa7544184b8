// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/synthetic/scene/photon_noise.h"

#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

namespace msc_vo {
namespace {

RenderedImage Flat(uint8_t value) {
  RenderedImage image;
  image.width = 160;
  image.height = 120;
  image.rgb.assign(3 * 160 * 120, value);
  return image;
}

TEST(PhotonNoise, KeepsTheBrightnessAndGrowsWithIt) {
  for (const double light : {1.0, 0.2}) {
    PhotonNoiseOptions options;
    options.light = light;
    for (const uint8_t value : {40, 80, 120}) {
      RenderedImage image = Flat(value);
      AddPhotonNoise(options, 1, 0, &image);
      double sum = 0.0, squares = 0.0;
      for (const uint8_t noisy : image.rgb) {
        sum += noisy;
        squares += (noisy - value) * (noisy - value);
      }
      const double count = static_cast<double>(image.rgb.size());
      const double variance = value / (4.0 * light) + 1.2 * 1.2 / (light * light);
      EXPECT_NEAR(sum / count, value, 0.3) << value << " in " << light;
      EXPECT_NEAR(squares / count / variance, 1.0, 0.03) << value << " in " << light;
    }
  }
}

TEST(PhotonNoise, IsIndependentBetweenColours) {
  RenderedImage image = Flat(100);
  AddPhotonNoise({}, 1, 0, &image);
  double products = 0.0, squares = 0.0;
  for (size_t i = 0; i < image.rgb.size(); i += 3) {
    products += (image.rgb[i] - 100.0) * (image.rgb[i + 1] - 100.0);
    squares += (image.rgb[i] - 100.0) * (image.rgb[i] - 100.0);
  }
  EXPECT_NEAR(products / squares, 0.0, 0.03);
}

TEST(PhotonNoise, LeavesSaturatedPixels) {
  RenderedImage image = Flat(255);
  AddPhotonNoise({}, 1, 0, &image);
  EXPECT_EQ(image.rgb, Flat(255).rgb);
}

TEST(PhotonNoise, DependsOnSeedAndFrameOnly) {
  RenderedImage a = Flat(100), b = Flat(100), other_frame = Flat(100), other_seed = Flat(100);
  AddPhotonNoise({}, 1, 3, &a);
  AddPhotonNoise({}, 1, 3, &b);
  AddPhotonNoise({}, 1, 4, &other_frame);
  AddPhotonNoise({}, 2, 3, &other_seed);
  EXPECT_EQ(a.rgb, b.rgb);
  EXPECT_NE(a.rgb, other_frame.rgb);
  EXPECT_NE(a.rgb, other_seed.rgb);
}

TEST(PhotonNoise, RejectsInvalidOptions) {
  RenderedImage image = Flat(100);
  for (const double light : {0.0, -0.1, 1.1, std::nan("")}) {
    PhotonNoiseOptions options;
    options.light = light;
    EXPECT_THROW(AddPhotonNoise(options, 1, 0, &image), std::invalid_argument) << light;
  }
}

}  // namespace
}  // namespace msc_vo
