// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/features/internal/fast_corners.h"

#include <algorithm>
#include <array>
#include <random>
#include <stdexcept>
#include <vector>

#include "tests/features/drawing.h"
#include <gtest/gtest.h>

namespace msc_vo {
namespace {

// Response by definition, pixel by pixel.
int Response(const cv::Mat& image, int x, int y) {
  constexpr std::array<std::array<int, 2>, 16> kCircle = {{{0, -3},
                                                           {1, -3},
                                                           {2, -2},
                                                           {3, -1},
                                                           {3, 0},
                                                           {3, 1},
                                                           {2, 2},
                                                           {1, 3},
                                                           {0, 3},
                                                           {-1, 3},
                                                           {-2, 2},
                                                           {-3, 1},
                                                           {-3, 0},
                                                           {-3, -1},
                                                           {-2, -2},
                                                           {-1, -3}}};
  int response = 0;
  for (int first = 0; first < 16; ++first) {
    int brighter = 255, darker = 255;
    for (int i = first; i < first + 9; ++i) {
      const auto& [dx, dy] = kCircle[i % 16];
      const int difference = image.at<uint8_t>(y + dy, x + dx) - image.at<uint8_t>(y, x);
      brighter = std::min(brighter, difference);
      darker = std::min(darker, -difference);
    }
    response = std::max({response, brighter, darker});
  }
  return response;
}

std::vector<FastCorner> DetectByDefinition(const cv::Mat& image, const cv::Rect& area,
                                           int threshold) {
  std::vector<FastCorner> corners;
  for (int y = area.y; y < area.y + area.height; ++y) {
    for (int x = area.x; x < area.x + area.width; ++x) {
      const int response = Response(image, x, y);
      int around = 0;
      for (int v = -1; v <= 1; ++v) {
        for (int u = -1; u <= 1; ++u) {
          if (u != 0 || v != 0) around = std::max(around, Response(image, x + u, y + v));
        }
      }
      if (response > std::max(around, threshold)) corners.push_back({{x, y}, response});
    }
  }
  return corners;
}

void ExpectSame(const std::vector<FastCorner>& found, const std::vector<FastCorner>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].pixel, expected[i].pixel);
    EXPECT_EQ(found[i].response, expected[i].response);
  }
}

cv::Mat Noise(int width, int height) {
  cv::Mat image(height, width, CV_8UC1);
  std::mt19937 random(3);
  for (int i = 0; i < width * height; ++i) image.data[i] = static_cast<uint8_t>(random() % 256);
  return image;
}

TEST(FastCorners, MatchDefinition) {
  const cv::Mat drawn = testing::DrawQuadrilaterals(200, 150, {0.0, 0.0});
  const cv::Rect inside(4, 4, 192, 142);
  for (const int threshold : {1, 7, 20, 60}) {
    const auto expected = DetectByDefinition(drawn, inside, threshold);
    EXPECT_GT(expected.size(), 10u);
    ExpectSame(DetectFastCorners(drawn, inside, threshold), expected);
  }
  const cv::Mat noise = Noise(200, 150);
  EXPECT_GT(DetectByDefinition(noise, inside, 7).size(), 100u);
  ExpectSame(DetectFastCorners(noise, inside, 7), DetectByDefinition(noise, inside, 7));
}

TEST(FastCorners, MatchDefinitionForAreasOfAllWidths) {
  const cv::Mat image = Noise(70, 40);
  for (const int x : {4, 5, 19, 40}) {
    for (int width = 1; x + width <= 66; ++width) {
      const cv::Rect area(x, 10, width, 5);
      ExpectSame(DetectFastCorners(image, area, 5), DetectByDefinition(image, area, 5));
    }
  }
}

TEST(FastCorners, MatchDefinitionInViewOfLargerImage) {
  const cv::Mat image = Noise(120, 60)(cv::Rect(10, 5, 90, 50));
  const cv::Rect inside(4, 4, 82, 42);
  ExpectSame(DetectFastCorners(image, inside, 10), DetectByDefinition(image, inside, 10));
}

TEST(FastCorners, ThrowOnInvalidImageOrArea) {
  const cv::Mat image = Noise(70, 40);
  EXPECT_THROW(DetectFastCorners(image, {3, 4, 10, 10}, 7), std::invalid_argument);
  EXPECT_THROW(DetectFastCorners(image, {4, 4, 63, 10}, 7), std::invalid_argument);
  EXPECT_THROW(DetectFastCorners(Noise(20, 40), {4, 4, 12, 10}, 7), std::invalid_argument);
  cv::Mat color(40, 70, CV_8UC3, cv::Scalar(0, 0, 0));
  EXPECT_THROW(DetectFastCorners(color, {4, 4, 10, 10}, 7), std::invalid_argument);
}

}  // namespace
}  // namespace msc_vo
