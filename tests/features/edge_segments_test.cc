// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/features/internal/edge_segments.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/features/drawing.h"
#include <gtest/gtest.h>

namespace msc_vo {
namespace {

using Eigen::Vector2d;

// Largest distance of the end points of `segment` from the infinite line through `side`.
double Offset(const LineSegment2& side, const LineSegment2& segment) {
  return std::max(side.DistanceToLine(segment.start), side.DistanceToLine(segment.end));
}

TEST(ImageGradient, EqualsSlopeOfRamp) {
  cv::Mat ramp(20, 30, CV_8UC1);
  for (int y = 0; y < ramp.rows; ++y) {
    for (int x = 0; x < ramp.cols; ++x)
      ramp.at<uint8_t>(y, x) = static_cast<uint8_t>(4 * x + 2 * y);
  }
  ImageGradient gradient;
  gradient.Compute(ramp);
  const int inside = 10 * gradient.width() + 15;
  // Differences over two pixels, summed over three rows or columns.
  EXPECT_EQ(gradient.X(inside), 24);
  EXPECT_EQ(gradient.Y(inside), 12);
  EXPECT_EQ(gradient.Magnitude(inside), 36);
  EXPECT_FALSE(gradient.IsHorizontalEdge(inside));
  for (int x = 0; x < ramp.cols; ++x) EXPECT_EQ(gradient.Magnitude(x), 0);
}

TEST(EdgeDrawing, DrawsClosedEdgeOnce) {
  testing::Canvas canvas(200, 150, 60);
  canvas.FillRectangle(50, 40, 150, 110, 180);
  ImageGradient gradient;
  gradient.Compute(canvas.Render());
  EdgeDrawing drawing;
  drawing.Draw(gradient);
  // The whole perimeter except for the rounded corners, and no pixel twice.
  std::vector<int> pixels = drawing.pixels();
  EXPECT_NEAR(static_cast<double>(pixels.size()), 340.0, 12.0);
  std::sort(pixels.begin(), pixels.end());
  EXPECT_EQ(std::unique(pixels.begin(), pixels.end()), pixels.end());
  for (const EdgeDrawing::Chain& chain : drawing.chains()) {
    for (int i = chain.begin + 1; i < chain.end; ++i) {
      const int a = drawing.pixels()[i - 1];
      const int b = drawing.pixels()[i];
      EXPECT_LE(std::abs(a % 200 - b % 200), 1);
      EXPECT_LE(std::abs(a / 200 - b / 200), 1);
    }
  }
}

TEST(EdgeSegmentDetector, DetectsLinesOfAllDirections) {
  EdgeSegmentDetector detector;
  for (int degrees = 0; degrees < 180; degrees += 7) {
    const double angle = degrees * M_PI / 180.0;
    const Vector2d along(std::cos(angle), std::sin(angle));
    const Vector2d across(-along.y(), along.x());
    const Vector2d middle(150.2, 140.7);
    testing::Canvas canvas(300, 280, 80);
    canvas.FillPolygon(
        {middle - 500.0 * along, middle + 500.0 * along, middle + 500.0 * along + 500.0 * across,
         middle - 500.0 * along + 500.0 * across},
        150);
    const auto& segments = detector.Detect(canvas.Render(2.0));
    ASSERT_FALSE(segments.empty()) << degrees;
    const LineSegment2& longest =
        *std::max_element(segments.begin(), segments.end(),
                          [](const auto& a, const auto& b) { return a.Length() < b.Length(); });
    EXPECT_GT(longest.Length(), 200.0) << degrees;
    EXPECT_LT(Offset({middle, middle + 100.0 * along}, longest), 0.7) << degrees;
  }
}

TEST(EdgeSegmentDetector, SplitsCurves) {
  testing::Canvas canvas(400, 300, 60);
  std::vector<Vector2d> circle;
  for (int i = 0; i < 360; ++i) {
    const double angle = i * M_PI / 180.0;
    circle.push_back(Vector2d(200.0, 150.0) + 100.0 * Vector2d(std::cos(angle), std::sin(angle)));
  }
  canvas.FillPolygon(circle, 180);
  EdgeSegmentDetector detector;
  // All pixels of an arc are within one pixel of a line if its height h is at most 2 px; its length
  // is then at most 2 sqrt(2 r h) = 40 px.
  for (const LineSegment2& segment : detector.Detect(canvas.Render())) {
    EXPECT_LT(segment.Length(), 41.0);
  }
}

TEST(EdgeSegmentDetector, DetectsNoLongSegmentsInNoise) {
  cv::Mat noise(480, 640, CV_8UC1);
  std::mt19937 random(3);
  for (int y = 0; y < noise.rows; ++y) {
    for (int x = 0; x < noise.cols; ++x) noise.at<uint8_t>(y, x) = random() % 256;
  }
  // Smoothing correlates neighbouring gradients, so the bound for independent ones is exceeded
  // occasionally: by less than one in ten thousand pixels, and only by short segments.
  EdgeSegmentDetector detector;
  const auto& segments = detector.Detect(noise);
  EXPECT_LT(segments.size(), 30u);
  for (const LineSegment2& segment : segments) EXPECT_LT(segment.Length(), 24.0);
}

}  // namespace
}  // namespace msc_vo
