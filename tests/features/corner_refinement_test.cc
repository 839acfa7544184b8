// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/features/corner_refinement.h"

#include "tests/features/drawing.h"
#include <gtest/gtest.h>

namespace msc_vo {
namespace {

// The upper left corner of a bright square at `corner`.
cv::Mat DrawCorner(const Eigen::Vector2d& corner, double noise, uint32_t seed) {
  testing::Canvas canvas(60, 60, 70);
  canvas.FillRectangle(corner.x(), corner.y(), 200.0, 200.0, 190);
  cv::Mat image = canvas.Render();
  cv::GaussianBlur(image, image, cv::Size(), 0.8);  // as a lens does
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0.0, noise);
  for (int i = 0; i < image.rows * image.cols && noise > 0.0; ++i) {
    image.data[i] = cv::saturate_cast<uint8_t>(image.data[i] + normal(random));
  }
  return image;
}

TEST(CornerRefinement, FollowsSubPixelShifts) {
  const cv::Rect area(10, 10, 40, 40);
  const Eigen::Vector2d base(30.0, 30.0);
  const RefinedCorner first = RefineCorner(DrawCorner(base, 1.0, 1), area, cv::Point(31, 31));
  double worst = 0.0;
  for (int i = 1; i < 16; ++i) {
    const Eigen::Vector2d shift(0.125 * (i % 8), 0.125 * ((3 * i) % 8));
    const RefinedCorner moved =
        RefineCorner(DrawCorner(base + shift, 1.0, i + 1), area, cv::Point(31, 31));
    worst = std::max(worst, (moved.position - first.position - shift).cwiseAbs().maxCoeff());
  }
  EXPECT_LT(worst, 0.25);  // whole pixels are up to 0.5 px off
}

TEST(CornerRefinement, ClimbsToTheSamePixelFromAround) {
  const cv::Rect area(10, 10, 40, 40);
  const cv::Mat image = DrawCorner({30.2, 29.7}, 1.0, 3);
  const RefinedCorner center = RefineCorner(image, area, cv::Point(31, 31));
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      const RefinedCorner other =
          RefineCorner(image, area, center.pixel + cv::Point(2 * dx, 2 * dy));
      EXPECT_EQ(other.pixel, center.pixel);
      EXPECT_EQ(other.position, center.position);
    }
  }
}

TEST(CornerRefinement, StaysInsideItsAreaAndInFlatImages) {
  const cv::Mat image = DrawCorner({30.0, 30.0}, 0.0, 1);
  const cv::Rect area(33, 33, 10, 10);
  EXPECT_TRUE(area.contains(RefineCorner(image, area, cv::Point(33, 33)).pixel));
  const cv::Mat flat(60, 60, CV_8UC1, cv::Scalar(100));
  const RefinedCorner still = RefineCorner(flat, cv::Rect(10, 10, 40, 40), cv::Point(20, 25));
  EXPECT_EQ(still.pixel, cv::Point(20, 25));
  EXPECT_EQ(still.position, Eigen::Vector2d(20, 25));
}

}  // namespace
}  // namespace msc_vo
