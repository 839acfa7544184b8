// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/synthetic/scene/hunting_exposure.h"

#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

namespace msc_vo {
namespace {

constexpr int kWidth = 161, kHeight = 121;

// The image of an evenly lit wall `seconds` after the start.
RenderedImage Wall(double seconds, uint8_t value = 100) {
  RenderedImage image;
  image.width = kWidth;
  image.height = kHeight;
  image.rgb.assign(3 * kWidth * kHeight, value);
  ApplyHuntingExposure({}, seconds, &image);
  return image;
}

uint8_t At(const RenderedImage& image, int x, int y) { return image.rgb[3 * (y * kWidth + x)]; }

TEST(HuntingExposure, ChangesTheGainPeriodically) {
  const HuntingExposureOptions options;
  const auto center = [](double seconds) { return At(Wall(seconds), kWidth / 2, kHeight / 2); };
  EXPECT_EQ(center(0.0), 100);
  EXPECT_EQ(center(0.25 * options.period), 160);
  EXPECT_EQ(center(0.75 * options.period), 40);
  EXPECT_EQ(center(1.25 * options.period), 160);
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
  EXPECT_EQ(At(Wall(0.25 * HuntingExposureOptions().period, 200), kWidth / 2, kHeight / 2), 255);
}

TEST(HuntingExposure, RejectsInvalidOptions) {
  RenderedImage image = Wall(0.0);
  HuntingExposureOptions options;
  options.amplitude = 1.0;
  EXPECT_THROW(ApplyHuntingExposure(options, 0.0, &image), std::invalid_argument);
  options = {};
  options.period = 0.0;
  EXPECT_THROW(ApplyHuntingExposure(options, 0.0, &image), std::invalid_argument);
  options = {};
  options.vignetting = std::nan("");
  EXPECT_THROW(ApplyHuntingExposure(options, 0.0, &image), std::invalid_argument);
}

}  // namespace
}  // namespace msc_vo
