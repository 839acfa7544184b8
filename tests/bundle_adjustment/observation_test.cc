// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/bundle_adjustment/observation.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/support/factor_checks.h"

namespace msc_vo {
namespace {

const LineSegment2 kSegment{{100.0, 100.0}, {200.0, 100.0}};

// A skirting board that begins a metre behind the camera, to its right.
const LineSegment3 kPassing{{0.8, 0.5, -1.0}, {0.8, 0.5, 3.0}};

TEST(ObservedPart, IsTheWholeLineIfBothEndsAreInFront) {
  const std::optional<LinePart> part =
      ObservedPart(PinholeCamera(), kSegment, {{-0.6, 0.0, 2.0}, {0.8, 0.0, 2.0}});
  ASSERT_TRUE(part.has_value());
  EXPECT_TRUE(part->IsWhole());
}

TEST(ObservedPart, IsSeenBetweenTheEndsOfTheSegmentIfTheLinePassesTheCamera) {
  const PinholeCamera camera;
  const LineSegment2 seen{camera.Project(kPassing.At(0.6)), camera.Project(kPassing.At(0.9))};
  const std::optional<LinePart> part = ObservedPart(camera, seen, kPassing);
  ASSERT_TRUE(part.has_value());
  EXPECT_NEAR(part->start, 0.6, 1e-12);
  EXPECT_NEAR(part->end, 0.9, 1e-12);
  EXPECT_LT(LineResidual(camera, seen, 0.5, part->Of(kPassing)).norm(), 1e-9);
  // Three pixels across: the residual is that of the visible part.
  LineSegment2 shifted = seen;
  const Eigen::Vector2d d = seen.Direction();
  shifted.start += 3.0 * Eigen::Vector2d(-d.y(), d.x());
  shifted.end += 3.0 * Eigen::Vector2d(-d.y(), d.x());
  const std::optional<LinePart> beside = ObservedPart(camera, shifted, kPassing);
  ASSERT_TRUE(beside.has_value());
  EXPECT_NEAR(LineResidual(camera, shifted, 0.5, beside->Of(kPassing)).norm(), 6.0 * std::sqrt(2.0),
              0.1);
}

TEST(ObservedPart, IsMissingBehindTheCamera) {
  const LineSegment3 behind{{0.8, 0.5, -3.0}, {0.8, 0.5, -1.0}};
  EXPECT_FALSE(ObservedPart(PinholeCamera(), kSegment, behind).has_value());
}

TEST(ObservedPart, StaysInFrontAndOnTheLine) {
  const PinholeCamera camera;
  // Viewing rays that meet the line behind the camera, or beyond its end.
  const LineSegment2 opposite{{100.0, 100.0}, {140.0, 130.0}};
  const LineSegment2 longer{camera.Project(kPassing.At(0.8)), camera.Project(kPassing.At(1.5))};
  for (const LineSegment2& segment : {opposite, longer}) {
    const std::optional<LinePart> part = ObservedPart(camera, segment, kPassing);
    ASSERT_TRUE(part.has_value());
    EXPECT_GE(part->Of(kPassing).start.z(), kMinObservedDepth - 1e-12);
    EXPECT_GE(part->Of(kPassing).end.z(), kMinObservedDepth - 1e-12);
    EXPECT_LE(std::max(part->start, part->end), 1.0);
  }
}

TEST(ImageLineSigma, MatchesValuesByHand) {
  EXPECT_DOUBLE_EQ(ImageLineSigma(kSegment, 2.0, {100.0, 130.0}), 2.0);
  EXPECT_DOUBLE_EQ(ImageLineSigma(kSegment, 2.0, {200.0, 100.0}), 2.0);
  EXPECT_DOUBLE_EQ(ImageLineSigma(kSegment, 2.0, {150.0, 100.0}), 2.0 * std::sqrt(0.5));
  // One length beyond the end: (1 - 2)^2 + 2^2.
  EXPECT_DOUBLE_EQ(ImageLineSigma(kSegment, 2.0, {300.0, 100.0}), 2.0 * std::sqrt(5.0));
}

TEST(ImageLineSigma, IsLeastAtTheMiddleOfTheSegment) {
  for (double u = -400.0; u < 700.0; u += 7.0) {
    EXPECT_GE(ImageLineSigma(kSegment, 1.0, {u, 50.0}), std::sqrt(0.5) - 1e-12) << u;
  }
}

TEST(MakeLineReprojection, RowsHaveUnitVarianceOutsideTheSegment) {
  // The map line extends beyond the observed segment at both ends. The end points of the segment
  // have noise across the line.
  const PinholeCamera camera;
  const LineSegment3 line{{-0.6, 0.0, 2.0}, {0.8, 0.0, 2.0}};
  const LineSegment2 exact{camera.Project(line.At(0.3)), camera.Project(line.At(0.8))};
  RandomGeometry random(1);
  Eigen::Vector2d variance = Eigen::Vector2d::Zero();
  const int count = 4000;
  for (int i = 0; i < count; ++i) {
    LineSegment2 observed = exact;
    observed.start.y() += 0.5 * random.Normal();
    observed.end.y() += 0.5 * random.Normal();
    const LineReprojection factor = MakeLineReprojection(camera, observed, 0.5, line);
    Eigen::Vector2d r;
    factor.Residual(0, Eigen::Vector3d(line.start), &r[0]);
    factor.Residual(1, Eigen::Vector3d(line.end), &r[1]);
    variance += r.cwiseAbs2() / count;
  }
  EXPECT_THAT(variance, IsNear(Eigen::Vector2d(1.0, 1.0), 5.0 * std::sqrt(2.0 / count)));
}

TEST(MakeLineDepthReprojection, EvaluatesSigmasAtTheProjectedEndPoints) {
  const PinholeCamera camera;
  const LineSegment3 line{{-0.6, 0.0, 2.0}, {0.8, 0.0, 2.0}};
  const LineSegment2 observed{camera.Project(line.At(0.5)), camera.Project(line.At(1.0))};
  LineDepth depth;
  depth.start = depth.end = 0.49;  // 0.01 per metre off the line's 0.5
  depth.covariance << 1e-6, 0.0, 0.0, 1e-6;
  const LineDepthReprojection factor = MakeLineDepthReprojection(camera, observed, depth, line);
  double start, end;
  factor.Residual(0, Eigen::Vector3d(line.start), &start);
  factor.Residual(1, Eigen::Vector3d(line.end), &end);
  // The start is at s = -1: variance 2^2 + 1^2; the end at s = 1.
  EXPECT_NEAR(start, 0.01 / std::sqrt(5e-6), 1e-9);
  EXPECT_NEAR(end, 10.0, 1e-9);
}

TEST(InverseDepthAt, IsThatOfThePointOnTheMapLine) {
  const PinholeCamera camera;
  const LineSegment3 line{{-0.6, 0.1, 2.0}, {0.8, 0.2, 4.0}};
  const LineSegment2 observed{camera.Project(line.At(0.3)), camera.Project(line.At(0.8))};
  EXPECT_NEAR(*InverseDepthAt(camera, observed, line, 0.0), 1.0 / line.At(0.3).z(), 1e-9);
  EXPECT_NEAR(*InverseDepthAt(camera, observed, line, 1.0), 1.0 / line.At(0.8).z(), 1e-9);
}

TEST(InverseDepthAt, IsNulloptAlongAViewingRay) {
  const LineSegment3 ray{{0.3, -0.1, 1.7}, {0.6, -0.2, 3.4}};
  EXPECT_FALSE(InverseDepthAt(PinholeCamera(), kSegment, ray, 0.5));
  const LineSegment3 rounded{{0.3, -0.1, 1.7}, {0.9, -0.3, 5.1}};
  EXPECT_FALSE(InverseDepthAt(PinholeCamera(), kSegment, rounded, 0.5));
}

TEST(TestChiSquare, RejectsAnInconsistentDepthAlone) {
  EXPECT_EQ(TestChiSquare(5.0, 3.0, 9.0, 11.0), (InlierMask{true, true}));
  EXPECT_EQ(TestChiSquare(5.0, 7.0, 9.0, 11.0), (InlierMask{true, false}));
  EXPECT_EQ(TestChiSquare(9.5, 0.0, 9.0, 11.0), (InlierMask{false, false}));
}

TEST(IsInFront, RequiresBothEndPointsOfALine) {
  EXPECT_TRUE(IsInFront(Eigen::Vector3d(0.0, 0.0, 1.0)));
  EXPECT_FALSE(IsInFront(Eigen::Vector3d(0.0, 0.0, 0.05)));
  EXPECT_TRUE(IsInFront(LineSegment3{{0.0, 0.0, 1.0}, {0.0, 1.0, 2.0}}));
  EXPECT_FALSE(IsInFront(LineSegment3{{0.0, 0.0, 1.0}, {0.0, 1.0, -2.0}}));
  EXPECT_FALSE(IsInFront(LineSegment3{{0.0, 0.0, -1.0}, {0.0, 1.0, 2.0}}));
}

}  // namespace
}  // namespace msc_vo
