// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/evaluation/line_error.h"

#include <cmath>

#include <gtest/gtest.h>

#include "msc_vo/geometry/angles.h"
#include "msc_vo/geometry/so3.h"

namespace msc_vo {
namespace {

using Vec = Eigen::Vector3d;

// Three edges of a box, viewed along +y: two vertical edges 4 cm apart and a horizontal one.
const std::vector<LineSegment3> kEdges = {{{0.0, 2.0, 0.0}, {0.0, 2.0, 2.0}},
                                          {{0.04, 2.0, 0.0}, {0.04, 2.0, 2.0}},
                                          {{0.0, 2.0, 2.0}, {1.0, 2.0, 2.0}}};

// A line with enough observations, viewed along +y.
EstimatedLine Observed(const LineSegment3& segment) { return {segment, 5, Vec::UnitY()}; }

// The part of the first edge from 0.5 to 1.5 m, translated.
EstimatedLine Moved(const Vec& by) { return Observed({Vec(0, 2, 0.5) + by, Vec(0, 2, 1.5) + by}); }

LineError Evaluate(const std::vector<EstimatedLine>& lines) {
  return EvaluateLines(kEdges, lines, Rigid3());
}

TEST(EvaluateLines, ExactLinesHaveZeroError) {
  std::vector<EstimatedLine> lines;
  for (const LineSegment3& edge : kEdges) {
    lines.push_back(Observed(edge));
    lines.push_back(Observed({edge.end, edge.At(0.3)}));  // a part of the edge, reversed
  }
  const LineError error = Evaluate(lines);
  EXPECT_EQ(error.num_lines, 6);
  EXPECT_EQ(error.num_counted, 6);
  EXPECT_EQ(error.num_matched, 6);
  EXPECT_EQ(error.num_edges, 3);
  EXPECT_EQ(error.num_edges_found, 3);
  EXPECT_NEAR(error.direction.max, 0.0, 1e-12);
  EXPECT_NEAR(error.distance.max, 0.0, 1e-12);
}

TEST(EvaluateLines, MeasuresRotationAndTranslation) {
  const double turn = DegreesToRadians(12.0);  // in depth, where the bounds are wide
  const LineSegment3 turned = {Vec(0, 2, 1) - 0.5 * Vec(0, std::sin(turn), std::cos(turn)),
                               Vec(0, 2, 1) + 0.5 * Vec(0, std::sin(turn), std::cos(turn))};
  const LineError direction = Evaluate({Observed(turned)});
  ASSERT_EQ(direction.num_matched, 1);
  EXPECT_NEAR(direction.direction.max, turn, 1e-12);
  EXPECT_NEAR(direction.distance.max, 0.0, 1e-12);

  // 3 mm beside and 4 mm behind the edge; translation along the edge is no error.
  const LineError shifted = Evaluate({Moved({0.003, 0.004, 0.1}), Moved({0.0, 0.02, 0.0})});
  ASSERT_EQ(shifted.num_matched, 2);
  EXPECT_EQ(shifted.num_edges_found, 1);
  EXPECT_NEAR(shifted.distance.max, 0.02, 1e-12);
  EXPECT_NEAR(shifted.distance.mean, 0.0125, 1e-12);
  EXPECT_NEAR(shifted.across.max, 0.003, 1e-12);
  EXPECT_NEAR(shifted.direction.max, 0.0, 1e-12);
}

TEST(EvaluateLines, AppliesAlignment) {
  const Rigid3 reference_from_estimate(ExpSO3({0.3, -0.8, 1.1}), {4.0, -1.0, 0.5});
  const Rigid3 inverse = reference_from_estimate.Inverse();
  const EstimatedLine line = Moved({0.0, 0.05, 0.0});
  const EstimatedLine in_map = {inverse * line.segment, line.num_observations,
                                inverse.rotation() * line.viewing_direction};
  const LineError error = EvaluateLines(kEdges, {in_map}, reference_from_estimate);
  ASSERT_EQ(error.num_matched, 1);
  EXPECT_NEAR(error.distance.max, 0.05, 1e-12);
  EXPECT_NEAR(error.across.max, 0.0, 1e-12);
}

TEST(EvaluateLines, MatchesEdgesByImagePosition) {
  // 6 cm in front of the second edge: it is matched with that edge, even if another edge is closer
  // in space.
  const LineError error = Evaluate({Moved({0.041, -0.06, 0.0})});
  ASSERT_EQ(error.num_matched, 1);
  EXPECT_NEAR(error.across.max, 0.001, 1e-12);
  EXPECT_NEAR(error.distance.max, std::hypot(0.001, 0.06), 1e-12);
  std::vector<LineSegment3> edges = kEdges;
  edges.push_back({{0.055, 1.94, 0.0}, {0.055, 1.94, 2.0}});  // 14 mm beside the line, at its depth
  EXPECT_NEAR(EvaluateLines(edges, {Moved({0.041, -0.06, 0.0})}, Rigid3()).across.max, 0.001,
              1e-12);
}

TEST(EvaluateLines, LeavesLinesBeyondBoundsUnmatched) {
  const double turn = DegreesToRadians(30.0), swing = DegreesToRadians(4.0);
  const EstimatedLine others[] = {
      Moved({-0.012, 0.0, 0.0}),  // beside the first edge
      Moved({0.0, 0.12, 0.0}),    // far behind it
      Moved({0.0, 0.0, 1.2}),     // above its end
      // Rotated about the midpoint, in depth and in the image.
      Observed({Vec(0, 2, 1) - 0.2 * Vec(0, std::sin(turn), std::cos(turn)),
                Vec(0, 2, 1) + 0.2 * Vec(0, std::sin(turn), std::cos(turn))}),
      Observed({Vec(0, 2, 1) - 0.2 * Vec(std::sin(swing), 0, std::cos(swing)),
                Vec(0, 2, 1) + 0.2 * Vec(std::sin(swing), 0, std::cos(swing))}),
  };
  for (const EstimatedLine& line : others) {
    const LineError error = Evaluate({line});
    EXPECT_EQ(error.num_counted, 1);
    EXPECT_EQ(error.num_matched, 0);
    EXPECT_EQ(error.direction.count, 0);
  }
}

TEST(EvaluateLines, SkipsShortLinesAndLinesWithTwoObservations) {
  EstimatedLine observed_twice = Moved(Vec::Zero());
  observed_twice.num_observations = 2;
  const EstimatedLine is_short = Observed({{0, 2, 1.0}, {0, 2, 1.19}});
  const EstimatedLine has_no_length = Observed({{0, 2, 1.0}, {0, 2, 1.0}});
  const LineError error = Evaluate({observed_twice, is_short, has_no_length});
  EXPECT_EQ(error.num_lines, 3);
  EXPECT_EQ(error.num_counted, 0);
  EXPECT_EQ(error.num_matched, 0);
}

TEST(EvaluateLines, LineViewedEndOnHasNoErrorAcross) {
  EstimatedLine line = Moved({0.02, 0.02, 0.0});
  line.viewing_direction = Vec::UnitZ();
  const LineError error = Evaluate({line});
  ASSERT_EQ(error.num_matched, 1);
  EXPECT_EQ(error.across.max, 0.0);
  EXPECT_NEAR(error.distance.max, 0.02 * std::sqrt(2.0), 1e-12);
}

TEST(EvaluateLines, ThrowsOnEdgesWithoutLength) {
  EXPECT_THROW(EvaluateLines({{{1, 1, 1}, {1, 1, 1}}}, {}, Rigid3()), std::invalid_argument);
}

}  // namespace
}  // namespace msc_vo
