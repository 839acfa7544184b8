// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/features/internal/line_refinement.h"

#include <cmath>

#include "tests/features/drawing.h"
#include <gtest/gtest.h>

namespace msc_vo {
namespace {

TEST(LineRefinement, LocatesSlantedEdgeToSubPixels) {
  // Bright below the line through (20, 60.3) and (180, 82.7).
  testing::Canvas canvas(200, 150, 60);
  const Eigen::Vector2d a(20.0, 60.3);
  const Eigen::Vector2d b(180.0, 82.7);
  const Eigen::Vector2d d = (b - a) / 160.0;
  canvas.FillPolygon({a - 40.0 * d, b + 40.0 * d, {250.0, 250.0}, {-50.0, 250.0}}, 180);
  const LineSegment2 truth{a, b};
  const cv::Mat image = canvas.Render(2.0);
  // Typical error of a detector: 0.8 px at one end, 0.6 px in the other direction at the other.
  LineSegment2 segment{Eigen::Vector2d(40.0, truth.At(0.125).y() + 0.8),
                       Eigen::Vector2d(160.0, truth.At(0.875).y() - 0.6)};
  ASSERT_TRUE(RefineSegment(image, &segment));
  // The drawing is accurate to an eighth of a pixel.
  EXPECT_LT(truth.DistanceToLine(segment.start), 0.2);
  EXPECT_LT(truth.DistanceToLine(segment.end), 0.2);
  EXPECT_NEAR(segment.start.x(), 40.0, 0.2);  // moves only across the segment
}

TEST(LineRefinement, RejectsSegmentWithoutEdge) {
  const cv::Mat flat(150, 200, CV_8UC1, cv::Scalar(90));
  LineSegment2 segment{Eigen::Vector2d(40, 60), Eigen::Vector2d(160, 70)};
  EXPECT_FALSE(RefineSegment(flat, &segment));
  EXPECT_EQ(segment.start, Eigen::Vector2d(40, 60));
  // An edge with its bright side on the other side.
  testing::Canvas canvas(200, 150, 180);
  canvas.FillRectangle(-10, 70.5, 300, 300, 60);
  LineSegment2 wrong{Eigen::Vector2d(40, 70), Eigen::Vector2d(160, 70)};
  EXPECT_FALSE(RefineSegment(canvas.Render(), &wrong));
  // At the border, the profile leaves the image on one side.
  LineSegment2 border{Eigen::Vector2d(40, 0), Eigen::Vector2d(160, 0)};
  EXPECT_FALSE(RefineSegment(canvas.Render(), &border));
}

TEST(LineRefinement, IgnoresSamplesAtOtherEdges) {
  // A bright bar crosses the line: the samples within it have no edge or another one.
  testing::Canvas canvas(200, 150, 60);
  canvas.FillRectangle(-10, 70.5, 300, 300, 160);
  canvas.FillRectangle(90, -10, 104, 300, 230);
  LineSegment2 segment{Eigen::Vector2d(30, 71), Eigen::Vector2d(170, 70)};
  ASSERT_TRUE(RefineSegment(canvas.Render(1.0), &segment));
  EXPECT_NEAR(segment.start.y(), 70.5, 0.1);
  EXPECT_NEAR(segment.end.y(), 70.5, 0.1);
}

}  // namespace
}  // namespace msc_vo
