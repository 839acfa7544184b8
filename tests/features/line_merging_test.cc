// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/features/line_merging.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace msc_vo {
namespace {

LineSegment2 Segment(double x0, double y0, double x1, double y1) {
  return {Eigen::Vector2d(x0, y0), Eigen::Vector2d(x1, y1)};
}

TEST(LineMerging, JoinsPiecesOfOneLine) {
  const auto merged = MergeCollinear(
      {}, {Segment(10, 20, 50, 20.5), Segment(60, 20.2, 90, 20), Segment(98, 20.4, 130, 20.1)});
  ASSERT_EQ(merged.size(), 1u);
  EXPECT_NEAR(merged[0].start.x(), 10.0, 0.1);
  EXPECT_NEAR(merged[0].end.x(), 130.0, 0.1);
  EXPECT_NEAR(merged[0].start.y(), 20.2, 0.4);
  EXPECT_NEAR(merged[0].end.y(), 20.2, 0.4);
}

TEST(LineMerging, KeepsWhatTheGatesForbid) {
  // A gap of 20 px, a distance of 5 px, an angle of 10 degrees, the opposite direction.
  EXPECT_EQ(MergeCollinear({}, {Segment(0, 0, 50, 0), Segment(70, 0, 110, 0)}).size(), 2u);
  EXPECT_EQ(MergeCollinear({}, {Segment(0, 0, 50, 0), Segment(55, 5, 95, 5)}).size(), 2u);
  EXPECT_EQ(MergeCollinear({}, {Segment(0, 0, 50, 0), Segment(52, 0, 62, 1.76)}).size(), 2u);
  EXPECT_EQ(MergeCollinear({}, {Segment(0, 0, 50, 0), Segment(95, 0, 55, 0)}).size(), 2u);
}

TEST(LineMerging, GatesAreOptions) {
  LineMergingOptions options;
  options.max_gap = 25.0;
  EXPECT_EQ(MergeCollinear(options, {Segment(0, 0, 50, 0), Segment(70, 0, 110, 0)}).size(), 1u);
  options = LineMergingOptions();
  options.max_distance = 6.0;
  EXPECT_EQ(MergeCollinear(options, {Segment(0, 0, 50, 0), Segment(55, 5, 95, 5)}).size(), 1u);
}

TEST(LineMerging, OrderDoesNotMatter) {
  std::vector<LineSegment2> segments = {Segment(10, 20, 50, 20.5),    Segment(60, 20.2, 90, 20),
                                        Segment(98, 20.4, 130, 20.1), Segment(40, 70, 80, 110),
                                        Segment(85, 115, 100, 130),   Segment(60, 22.5, 90, 22.5),
                                        Segment(200, 10, 200, 50),    Segment(200, 60, 200, 100)};
  const auto first = MergeCollinear({}, segments);
  EXPECT_LT(first.size(), segments.size());
  for (int rotation = 0; rotation < 8; ++rotation) {
    std::rotate(segments.begin(), segments.begin() + 1, segments.end());
    if (rotation == 4) std::swap(segments[0], segments[5]);
    const auto again = MergeCollinear({}, segments);
    ASSERT_EQ(again.size(), first.size());
    for (size_t i = 0; i < first.size(); ++i) {
      EXPECT_EQ(again[i].start, first[i].start);
      EXPECT_EQ(again[i].end, first[i].end);
    }
  }
}

TEST(LineMerging, LongestFirst) {
  const auto merged =
      MergeCollinear({}, {Segment(0, 0, 10, 0), Segment(0, 50, 40, 50), Segment(0, 90, 25, 90)});
  ASSERT_EQ(merged.size(), 3u);
  EXPECT_GT(merged[0].Length(), merged[1].Length());
  EXPECT_GT(merged[1].Length(), merged[2].Length());
  EXPECT_TRUE(MergeCollinear({}, {}).empty());
}

TEST(LineMerging, OptionsAreChecked) {
  std::string error;
  LineMergingOptions options;
  EXPECT_TRUE(options.IsValid(&error));
  options.max_angle = 1.0;
  EXPECT_FALSE(options.IsValid(&error));
  EXPECT_NE(error.find("max_angle"), std::string::npos);
  options = LineMergingOptions();
  options.max_gap = -1.0;
  EXPECT_FALSE(options.IsValid(&error));
  options = LineMergingOptions();
  options.max_distance = -1.0;
  EXPECT_FALSE(options.IsValid(&error));
}

}  // namespace
}  // namespace msc_vo
