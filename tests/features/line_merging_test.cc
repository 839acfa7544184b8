// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/features/internal/line_merging.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "msc_vo/geometry/angles.h"

namespace msc_vo {
namespace {

LineSegment2 Segment(double x0, double y0, double x1, double y1) {
  return {Eigen::Vector2d(x0, y0), Eigen::Vector2d(x1, y1)};
}

TEST(LineMerging, MergesPiecesOfOneLine) {
  const auto merged = MergeCollinear(
      {Segment(10, 20, 50, 20.5), Segment(60, 20.2, 90, 20), Segment(98, 20.4, 130, 20.1)});
  ASSERT_EQ(merged.size(), 1u);
  EXPECT_NEAR(merged[0].start.x(), 10.0, 0.1);
  EXPECT_NEAR(merged[0].end.x(), 130.0, 0.1);
  EXPECT_NEAR(merged[0].start.y(), 20.2, 0.4);
  EXPECT_NEAR(merged[0].end.y(), 20.2, 0.4);
}

// Number of segments that remain of one along the x axis, 0 to 50, and another one.
size_t NumMerged(const LineSegment2& other) {
  return MergeCollinear({Segment(0, 0, 50, 0), other}).size();
}

TEST(LineMerging, RejectsLargeGaps) {
  EXPECT_EQ(NumMerged(Segment(64, 0, 104, 0)), 1u);
  EXPECT_EQ(NumMerged(Segment(66, 0, 106, 0)), 2u);
}

// The common line lies between the two segments.
TEST(LineMerging, RejectsParallelSegmentsFarApart) {
  EXPECT_EQ(NumMerged(Segment(52, 2, 92, 2)), 1u);
  EXPECT_EQ(NumMerged(Segment(55, 5, 95, 5)), 2u);
}

TEST(LineMerging, RejectsLargeAngles) {
  const auto at_angle = [](double degrees) {
    const double slope = std::tan(DegreesToRadians(degrees));
    return Segment(52, 0, 62, 10.0 * slope);
  };
  EXPECT_EQ(NumMerged(at_angle(4.9)), 1u);
  EXPECT_EQ(NumMerged(at_angle(5.1)), 2u);
}

TEST(LineMerging, RejectsOppositeDirections) {
  EXPECT_EQ(NumMerged(Segment(55, 0, 95, 0)), 1u);
  EXPECT_EQ(NumMerged(Segment(95, 0, 55, 0)), 2u);
}

TEST(LineMerging, IsIndependentOfOrder) {
  std::vector<LineSegment2> segments = {Segment(10, 20, 50, 20.5),    Segment(60, 20.2, 90, 20),
                                        Segment(98, 20.4, 130, 20.1), Segment(40, 70, 80, 110),
                                        Segment(85, 115, 100, 130),   Segment(60, 22.5, 90, 22.5),
                                        Segment(200, 10, 200, 50),    Segment(200, 60, 200, 100)};
  const auto first = MergeCollinear(segments);
  EXPECT_LT(first.size(), segments.size());
  for (int rotation = 0; rotation < 8; ++rotation) {
    std::rotate(segments.begin(), segments.begin() + 1, segments.end());
    if (rotation == 4) std::swap(segments[0], segments[5]);
    const auto again = MergeCollinear(segments);
    ASSERT_EQ(again.size(), first.size());
    for (size_t i = 0; i < first.size(); ++i) {
      EXPECT_EQ(again[i].start, first[i].start);
      EXPECT_EQ(again[i].end, first[i].end);
    }
  }
}

TEST(LineMerging, SortsByLength) {
  const auto merged =
      MergeCollinear({Segment(0, 0, 10, 0), Segment(0, 50, 40, 50), Segment(0, 90, 25, 90)});
  ASSERT_EQ(merged.size(), 3u);
  EXPECT_GT(merged[0].Length(), merged[1].Length());
  EXPECT_GT(merged[1].Length(), merged[2].Length());
  EXPECT_TRUE(MergeCollinear({}).empty());
}

}  // namespace
}  // namespace msc_vo
