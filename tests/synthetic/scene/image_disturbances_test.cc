// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/synthetic/scene/image_disturbances.h"

#include <cstdint>

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
    for (const uint8_t value : {40, 80, 120}) {
      RenderedImage image = Flat(value);
      AddPhotonNoise(light, 1, 0, &image);
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
  AddPhotonNoise(1.0, 1, 0, &image);
  double products = 0.0, squares = 0.0;
  for (size_t i = 0; i < image.rgb.size(); i += 3) {
    products += (image.rgb[i] - 100.0) * (image.rgb[i + 1] - 100.0);
    squares += (image.rgb[i] - 100.0) * (image.rgb[i] - 100.0);
  }
  EXPECT_NEAR(products / squares, 0.0, 0.03);
}

TEST(PhotonNoise, LeavesSaturatedPixels) {
  RenderedImage image = Flat(255);
  AddPhotonNoise(1.0, 1, 0, &image);
  EXPECT_EQ(image.rgb, Flat(255).rgb);
}

TEST(PhotonNoise, DependsOnSeedAndFrameOnly) {
  RenderedImage a = Flat(100), b = Flat(100), other_frame = Flat(100), other_seed = Flat(100);
  AddPhotonNoise(1.0, 1, 3, &a);
  AddPhotonNoise(1.0, 1, 3, &b);
  AddPhotonNoise(1.0, 1, 4, &other_frame);
  AddPhotonNoise(1.0, 2, 3, &other_seed);
  EXPECT_EQ(a.rgb, b.rgb);
  EXPECT_NE(a.rgb, other_frame.rgb);
  EXPECT_NE(a.rgb, other_seed.rgb);
}

constexpr int kWidth = 161, kHeight = 121;

// The image of an evenly lit wall `seconds` after the start.
RenderedImage Wall(double seconds, uint8_t value = 100) {
  RenderedImage image;
  image.width = kWidth;
  image.height = kHeight;
  image.rgb.assign(3 * kWidth * kHeight, value);
  ApplyHuntingExposure(seconds, &image);
  return image;
}

uint8_t At(const RenderedImage& image, int x, int y) { return image.rgb[3 * (y * kWidth + x)]; }

TEST(HuntingExposure, ChangesTheGainPeriodically) {
  constexpr double kPeriod = 1.9;  // seconds
  const auto center = [](double seconds) { return At(Wall(seconds), kWidth / 2, kHeight / 2); };
  EXPECT_EQ(center(0.0), 100);
  EXPECT_EQ(center(0.25 * kPeriod), 160);
  EXPECT_EQ(center(0.75 * kPeriod), 40);
  EXPECT_EQ(center(1.25 * kPeriod), 160);
}

TEST(HuntingExposure, DarkensTheCorners) {
  const RenderedImage image = Wall(0.0);
  for (const int x : {0, kWidth - 1}) {
    for (const int y : {0, kHeight - 1}) EXPECT_EQ(At(image, x, y), 45);
  }
  EXPECT_GT(At(image, 0, kHeight / 2), 45);
  EXPECT_LT(At(image, 0, kHeight / 2), 100);
}

TEST(HuntingExposure, Saturates) {
  EXPECT_EQ(At(Wall(0.25 * 1.9, 200), kWidth / 2, kHeight / 2), 255);
}

}  // namespace
}  // namespace msc_vo
