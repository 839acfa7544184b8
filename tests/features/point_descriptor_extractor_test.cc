// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/features/point_descriptor_extractor.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "tests/features/drawing.h"
#include <gtest/gtest.h>

#include "msc_vo/features/fast_corners.h"
#include "msc_vo/geometry/angles.h"

namespace msc_vo {
namespace {

constexpr int kBorder = PointDescriptorExtractor::kBorder;

struct Picture {
  cv::Mat gray;
  cv::Mat smooth;

  explicit Picture(const cv::Mat& image) : gray(image) {
    cv::GaussianBlur(gray, smooth, cv::Size(5, 5), 0.0);
  }
  PointDescriptorExtractor descriptor_extractor() const { return {gray, smooth}; }
};

// Every seventh pixel that may be described.
std::vector<cv::Point> Places(const cv::Size& size) {
  std::vector<cv::Point> places;
  for (int y = kBorder; y < size.height - kBorder; y += 7) {
    for (int x = kBorder; x < size.width - kBorder; x += 7) places.emplace_back(x, y);
  }
  return places;
}

TEST(PointDescriptorExtractor, AnglePointsToTheBrightSide) {
  for (const double degrees : {0.0, 30.0, 90.0, -120.0, 179.0}) {
    const double angle = DegreesToRadians(degrees);
    cv::Mat ramp(60, 60, CV_8UC1);
    for (int y = 0; y < 60; ++y) {
      for (int x = 0; x < 60; ++x) {
        ramp.at<uint8_t>(y, x) = cv::saturate_cast<uint8_t>(
            128.0 + 2.5 * ((x - 30) * std::cos(angle) + (y - 30) * std::sin(angle)));
      }
    }
    const Picture picture(ramp);
    EXPECT_NEAR(picture.descriptor_extractor().Angle({30, 30}), angle, DegreesToRadians(0.5));
  }
}

TEST(PointDescriptorExtractor, QuarterTurnsTurnAngleAndKeepDescriptor) {
  const Picture picture(testing::DrawQuadrilaterals(161, 161, {0.0, 0.0}));
  cv::Mat turned_image;
  cv::rotate(picture.gray, turned_image, cv::ROTATE_90_CLOCKWISE);
  const Picture turned(turned_image);
  for (const cv::Point& place : Places(picture.gray.size())) {
    const cv::Point there(160 - place.y, place.x);
    const double angle = picture.descriptor_extractor().Angle(place);
    EXPECT_NEAR(
        std::remainder(turned.descriptor_extractor().Angle(there) - angle - kPi / 2.0, 2.0 * kPi),
        0.0, 1e-9);
    // Half pixels are rounded to one side: few pairs compare other pixels.
    EXPECT_LE(HammingDistance(picture.descriptor_extractor().Describe(place, angle),
                              turned.descriptor_extractor().Describe(there, angle + kPi / 2.0)),
              16);
  }
}

cv::Mat WithNoise(const cv::Mat& image, uint32_t seed) {
  cv::Mat noisy = image.clone();
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0.0, 2.0);
  for (int i = 0; i < image.rows * image.cols; ++i) {
    noisy.data[i] = cv::saturate_cast<uint8_t>(image.data[i] + normal(random));
  }
  return noisy;
}

// What matching rests on: the same patch with other noise and another contrast is near, another
// patch is half of the bits away.
TEST(PointDescriptorExtractor, TellsPatchesApart) {
  const cv::Mat image = testing::DrawQuadrilaterals(320, 240, {0.0, 0.0}, 0.0, /*noise=*/0.0);
  cv::Mat darker;
  image.convertTo(darker, CV_8U, 0.6, 20.0);
  const Picture a(WithNoise(image, 1)), b(WithNoise(darker, 2));
  const auto corners = DetectFastCorners(
      image, cv::Rect(kBorder, kBorder, 320 - 2 * kBorder, 240 - 2 * kBorder), 20);
  std::vector<double> same, other;
  for (size_t i = 0; i < corners.size(); ++i) {
    const cv::Point& here = corners[i].pixel;
    const cv::Point& elsewhere = corners[(i + corners.size() / 2) % corners.size()].pixel;
    const Descriptor descriptor = a.descriptor_extractor().Describe(here, 0.0);
    same.push_back(HammingDistance(descriptor, b.descriptor_extractor().Describe(here, 0.0)));
    other.push_back(HammingDistance(descriptor, b.descriptor_extractor().Describe(elsewhere, 0.0)));
  }
  std::sort(same.begin(), same.end());
  std::sort(other.begin(), other.end());
  EXPECT_LT(same[same.size() * 9 / 10], other[other.size() / 10]);
  EXPECT_NEAR(other[other.size() / 2], 128.0, 20.0);
}

// What lies around an image, in a larger one that it is a view into, changes nothing.
TEST(PointDescriptorExtractor, StaysInsideAtTheBorder) {
  constexpr int kSize = 2 * kBorder + 1;
  const Picture picture(testing::DrawQuadrilaterals(kSize, kSize, {0.0, 0.0}));
  const cv::Point only(kBorder, kBorder);
  const auto framed = [](const cv::Mat& image, int surroundings) {
    cv::Mat larger;
    cv::copyMakeBorder(image, larger, 5, 5, 5, 5, cv::BORDER_CONSTANT, cv::Scalar(surroundings));
    return larger;
  };
  for (const int surroundings : {0, 255}) {
    const cv::Rect inside(5, 5, kSize, kSize);
    const cv::Mat gray = framed(picture.gray, surroundings)(inside);
    const cv::Mat smooth = framed(picture.smooth, surroundings)(inside);
    const PointDescriptorExtractor view(gray, smooth);
    EXPECT_EQ(view.Angle(only), picture.descriptor_extractor().Angle(only));
    for (double angle = 0.0; angle < 2.0 * kPi; angle += 0.1) {
      EXPECT_EQ(view.Describe(only, angle), picture.descriptor_extractor().Describe(only, angle));
    }
  }
}

}  // namespace
}  // namespace msc_vo
