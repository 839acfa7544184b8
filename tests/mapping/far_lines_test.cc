// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/mapping/far_lines.h"

#include <cmath>
#include <memory>

#include "tests/support/plane_features.h"
#include <gtest/gtest.h>

namespace msc_vo {
namespace {

constexpr double kRange = 5.0;   // of the sensor, metres
constexpr double kEnd = 6.0;     // of the wall, metres
constexpr double kColumn = 407;  // pixels, of its end: 319.5 + 525 / 6

// The end of a corridor, whose right wall is a metre beside the camera. Its end has no depth.
class FarLinesTest : public ::testing::Test {
 protected:
  FarLinesTest() {
    frame_.planes = {FeatureOf(Plane({-1.0, 0.0, 0.0}, 1.0))};
    frame_.depth_ranges.cells.resize(DepthRanges::kColumns * DepthRanges::kRows);
    for (int column = 0; column < DepthRanges::kColumns; ++column) {
      const double inverse_depth =
          frame_.camera.Ray(DepthRanges::CellCenter(frame_.camera, column, 0)).x();
      if (inverse_depth * kRange > 1.0) SetColumn(column, inverse_depth);
    }
    AddLine(kColumn);
  }

  // Gives depths to a column of cells.
  void SetColumn(int column, double inverse_depth) {
    for (int row = 0; row < DepthRanges::kRows; ++row) {
      frame_.depth_ranges.cells[row * DepthRanges::kColumns + column] = {
          static_cast<float>(inverse_depth), static_cast<float>(inverse_depth)};
    }
  }
  void AddLine(double column) {
    LineFeature line;
    line.segment = {{column, 180.0}, {column, 300.0}};
    frame_.lines.push_back(line);
  }
  std::shared_ptr<const Frame> Measure(const FrameMatches& matches = {}) const {
    return MeasureFarLines(matches, std::make_shared<Frame>(frame_));
  }
  bool IsMeasured() const { return Measure()->lines[0].HasDepth(); }

  Frame frame_;
};

TEST_F(FarLinesTest, EndsTheWallWhereTheImageDoes) {
  const std::shared_ptr<const Frame> measured = Measure();
  ASSERT_TRUE(measured->lines[0].HasDepth());
  const LineSegment3 line = measured->LineInCamera(0);
  EXPECT_NEAR(line.start.z(), kEnd, 1e-9);
  EXPECT_NEAR(line.end.x(), 1.0, 1e-9);
}

// A pixel moves the end by z^2 / f; the plane errs by 4e-3 times the length of the ray.
TEST_F(FarLinesTest, CountsTheErrorsOfThePlaneAndOfTheImage) {
  const LineDepth depth = *Measure()->lines[0].depth;
  const double of_plane = 4e-3 * frame_.camera.Ray(frame_.lines[0].segment.start).norm();
  EXPECT_NEAR(std::sqrt(depth.covariance(0, 0)), std::hypot(of_plane, 1.0 / 525.0), 1e-9);
}

TEST_F(FarLinesTest, LeavesOtherFramesAsTheyAre) {
  frame_.planes.clear();
  const auto frame = std::make_shared<const Frame>(frame_);
  EXPECT_EQ(MeasureFarLines({}, frame), frame);
}

TEST_F(FarLinesTest, LeavesLinesOfTheMapAsTheyAre) {
  FrameMatches matches;
  matches.lines = {{0, 17, LineSegment3(), true}};
  EXPECT_FALSE(Measure(matches)->lines[0].HasDepth());
}

TEST_F(FarLinesTest, MeasuresTheFirstLineBesideThePlaneOnly) {
  AddLine(kColumn + 8.0);
  const std::shared_ptr<const Frame> measured = Measure();
  EXPECT_FALSE(measured->lines[0].HasDepth());
  EXPECT_TRUE(measured->lines[1].HasDepth());
}

// There, the sensor would have measured the wall.
TEST_F(FarLinesTest, MeasuresNoLineWithinTheRange) {
  SetColumn(0, 0.9 / kEnd);
  EXPECT_FALSE(IsMeasured());
}

// A window, of which the wall is the farthest surface in the image.
TEST_F(FarLinesTest, MeasuresNoLineNearerThanTheRangeOfAnySensor) {
  frame_.planes = {FeatureOf(Plane({-1.0, 0.0, 0.0}, 0.4))};
  for (DepthRanges::Cell& cell : frame_.depth_ranges.cells) {
    cell.min_inverse_depth /= 0.4f;
    cell.max_inverse_depth /= 0.4f;
  }
  EXPECT_FALSE(IsMeasured());
}

TEST_F(FarLinesTest, MeasuresNoLineBetweenTwoPlanes) {
  frame_.planes.push_back(FeatureOf(Plane({0.0, 0.0, -1.0}, 3.0)));
  SetColumn(18, 1.0 / 3.0);
  EXPECT_FALSE(IsMeasured());
}

TEST_F(FarLinesTest, MeasuresNoLineBesideAnotherSurface) {
  for (int column = 21; column < DepthRanges::kColumns; ++column) SetColumn(column, 0.5);
  EXPECT_FALSE(IsMeasured());
}

TEST_F(FarLinesTest, MeasuresNoLineFarFromThePlaneInTheImage) {
  frame_.lines.clear();
  AddLine(325.0);
  EXPECT_FALSE(IsMeasured());
}

}  // namespace
}  // namespace msc_vo
