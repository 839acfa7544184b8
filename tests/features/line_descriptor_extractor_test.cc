// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/features/internal/line_descriptor_extractor.h"

#include "tests/features/drawing.h"
#include <gtest/gtest.h>

namespace msc_vo {
namespace {

using Eigen::Vector2d;

const LineSegment2 kSegment{Vector2d(200.0, 150.0), Vector2d(310.0, 240.0)};

Descriptor Describe(const cv::Mat& image, const LineSegment2& segment) {
  LineDescriptorExtractor descriptor_extractor;
  descriptor_extractor.SetImage(image);
  return descriptor_extractor.Describe(segment);
}

TEST(LineDescriptorExtractor, IsInvariantToContrastAndBrightness) {
  const cv::Mat image = testing::DrawQuadrilaterals(640, 480, {0.0, 0.0}, 0.0, 0.0);
  cv::Mat paler;
  image.convertTo(paler, CV_8U, 0.6, 50.0);
  // Rounding of grey values changes the result of close comparisons.
  EXPECT_LE(HammingDistance(Describe(image, kSegment), Describe(paler, kSegment)), 8);
}

TEST(LineDescriptorExtractor, IsInvariantToTranslationAndRotation) {
  const auto moved = [](const Vector2d& shift, double angle) {
    const Vector2d middle(319.5, 239.5);
    Eigen::Matrix2d turn;
    turn << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
    const auto move = [&](const Vector2d& x) -> Vector2d {
      return middle + turn * (x - middle) + shift;
    };
    return Describe(testing::DrawQuadrilaterals(640, 480, shift, angle, 0.0),
                    {move(kSegment.start), move(kSegment.end)});
  };
  const Descriptor original = moved({0.0, 0.0}, 0.0);
  EXPECT_LE(HammingDistance(original, moved({7.3, -4.6}, 0.0)), 30);
  EXPECT_LE(HammingDistance(original, moved({0.0, 0.0}, 0.6)), 40);
  EXPECT_LE(HammingDistance(original, moved({0.0, 0.0}, 3.0)), 40);
}

TEST(LineDescriptorExtractor, DistinguishesLinesAndDirections) {
  const cv::Mat image = testing::DrawQuadrilaterals(640, 480, {0.0, 0.0});
  const Descriptor here = Describe(image, kSegment);
  EXPECT_GT(HammingDistance(here, Describe(image, {kSegment.end, kSegment.start})), 80);
  EXPECT_GT(HammingDistance(here, Describe(image, {Vector2d(420.0, 90.0), Vector2d(500.0, 300.0)})),
            80);
}

TEST(LineDescriptorExtractor, DescribesLinesAlongBorder) {
  const cv::Mat image = testing::DrawQuadrilaterals(641, 479, {0.0, 0.0});
  LineDescriptorExtractor descriptor_extractor;
  descriptor_extractor.SetImage(image);
  const Vector2d corner(640.0, 478.0);
  const Descriptor along_border =
      descriptor_extractor.Describe({Vector2d(0.0, 0.0), Vector2d(0.0, 478.0)});
  EXPECT_EQ(along_border,
            descriptor_extractor.Describe({Vector2d(0.0, 0.0), Vector2d(0.0, 478.0)}));
  EXPECT_NE(along_border, descriptor_extractor.Describe({Vector2d(0.0, 0.0), corner}));
}

}  // namespace
}  // namespace msc_vo
