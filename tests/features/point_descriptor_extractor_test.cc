// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/features/internal/point_descriptor_extractor.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "tests/features/drawing.h"
#include <gtest/gtest.h>

#include "msc_vo/features/internal/fast_corners.h"
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

// Every seventh pixel that can be described.
std::vector<cv::Point> PixelGrid(const cv::Size& size) {
  std::vector<cv::Point> pixels;
  for (int y = kBorder; y < size.height - kBorder; y += 7) {
    for (int x = kBorder; x < size.width - kBorder; x += 7) pixels.emplace_back(x, y);
  }
  return pixels;
}

TEST(PointDescriptorExtractor, AnglePointsToBrightSide) {
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

TEST(PointDescriptorExtractor, IsInvariantToRotationBy90Degrees) {
  const Picture picture(testing::DrawQuadrilaterals(161, 161, {0.0, 0.0}));
  cv::Mat rotated_image;
  cv::rotate(picture.gray, rotated_image, cv::ROTATE_90_CLOCKWISE);
  const Picture rotated(rotated_image);
  for (const cv::Point& pixel : PixelGrid(picture.gray.size())) {
    const cv::Point rotated_pixel(160 - pixel.y, pixel.x);
    const double angle = picture.descriptor_extractor().Angle(pixel);
    const double rotated_angle = rotated.descriptor_extractor().Angle(rotated_pixel);
    EXPECT_NEAR(std::remainder(rotated_angle - angle - kPi / 2.0, 2.0 * kPi), 0.0, 1e-9);
    // Rounding of half pixels is not symmetric: few pairs compare different pixels.
    EXPECT_LE(
        HammingDistance(picture.descriptor_extractor().Describe(pixel, angle),
                        rotated.descriptor_extractor().Describe(rotated_pixel, angle + kPi / 2.0)),
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

// The distance is small between descriptors of one patch with different noise and contrast, and
// half of the bits between different patches.
TEST(PointDescriptorExtractor, DistinguishesPatches) {
  const cv::Mat image = testing::DrawQuadrilaterals(320, 240, {0.0, 0.0}, 0.0, /*noise=*/0.0);
  cv::Mat darker;
  image.convertTo(darker, CV_8U, 0.6, 20.0);
  const Picture a(WithNoise(image, 1)), b(WithNoise(darker, 2));
  const auto corners = DetectFastCorners(
      image, cv::Rect(kBorder, kBorder, 320 - 2 * kBorder, 240 - 2 * kBorder), 20);
  std::vector<double> same, other;
  for (size_t i = 0; i < corners.size(); ++i) {
    const cv::Point& here = corners[i].pixel;
    const Descriptor descriptor = a.descriptor_extractor().Describe(here, 0.0);
    same.push_back(HammingDistance(descriptor, b.descriptor_extractor().Describe(here, 0.0)));
    for (size_t j = i + 7; j < i + corners.size(); j += 7) {
      const cv::Point& elsewhere = corners[j % corners.size()].pixel;
      other.push_back(
          HammingDistance(descriptor, b.descriptor_extractor().Describe(elsewhere, 0.0)));
    }
  }
  std::sort(same.begin(), same.end());
  std::sort(other.begin(), other.end());
  EXPECT_LT(same[same.size() * 9 / 10], other[other.size() / 10]);
  EXPECT_NEAR(other[other.size() / 2], 128.0, 20.0);
}

// The image is a view of a larger one, whose other pixels must have no effect.
TEST(PointDescriptorExtractor, ReadsNoPixelsOutsideImage) {
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
