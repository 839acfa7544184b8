// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <cmath>

#include <gtest/gtest.h>

#include "msc_vo/geometry/angles.h"
#include "msc_vo/structure/internal/axes_evidence.h"

namespace msc_vo {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Unit vector in the plane of x and y, at an angle of `degrees` to x.
Vector3d InPlane(double degrees) {
  const double angle = DegreesToRadians(degrees);
  return {std::cos(angle), std::sin(angle), 0.0};
}

// Evidence of lines and normals with equal weights.
DirectionEvidence MakeEvidence(const std::vector<Vector3d>& lines,
                               const std::vector<Vector3d>& normals) {
  DirectionEvidence evidence;
  const double weight = 1.0 / static_cast<double>(lines.size() + normals.size());
  for (const Vector3d& direction : lines) evidence.all.push_back({direction, weight});
  for (const Vector3d& direction : normals) evidence.all.push_back({direction, weight});
  evidence.num_lines = lines.size();
  return evidence;
}

ScoredAxes Score(const DirectionEvidence& evidence, const Matrix3d& axes = Matrix3d::Identity()) {
  return ScoreAxes(evidence, axes);
}

TEST(AxesScore, CountsTheEvidenceInEachCone) {
  const ScoredAxes scored = Score(
      MakeEvidence({InPlane(0.0), InPlane(180.0), InPlane(90.0)}, {InPlane(90.0), InPlane(45.0)}));
  EXPECT_EQ(scored.num_lines, Vector3d(2.0, 1.0, 0.0));
  EXPECT_EQ(scored.num_normals, Vector3d(0.0, 1.0, 0.0));
  EXPECT_NEAR(scored.explained_ratio, 0.8, 1e-12);
}

TEST(AxesScore, ExcludesEvidenceOutsideTheCones) {
  const double max_angle = RadiansToDegrees(kAxisCone);
  const ScoredAxes scored =
      Score(MakeEvidence({InPlane(max_angle - 0.1), InPlane(max_angle + 0.1)}, {}));
  EXPECT_EQ(scored.num_lines, Vector3d(1.0, 0.0, 0.0));
  EXPECT_NEAR(scored.explained_ratio, 0.5, 1e-12);
}

TEST(AxesScore, MisfitIsTheAngleOfTheMeanDirection) {
  const ScoredAxes scored =
      Score(MakeEvidence({InPlane(2.0), InPlane(184.0), InPlane(91.0), InPlane(89.0)}, {}));
  EXPECT_NEAR(RadiansToDegrees(scored.misfit.x()), 3.0, 1e-3);
  EXPECT_NEAR(RadiansToDegrees(scored.misfit.y()), 0.0, 1e-3);
  EXPECT_EQ(scored.misfit.z(), 0.0);  // no evidence
}

TEST(AxesScore, DensityIsTheKernelOfTheTangentPlane) {
  const double tangent = std::tan(DegreesToRadians(3.0)) / kLastBandwidth;
  EXPECT_NEAR(Score(MakeEvidence({InPlane(0.0)}, {})).density, 1.0, 1e-12);
  EXPECT_NEAR(Score(MakeEvidence({InPlane(3.0)}, {})).density, std::exp(-0.5 * tangent * tangent),
              1e-9);
}

TEST(AxesScore, UsesTheFrameOfTheAxes) {
  Matrix3d axes;
  axes << InPlane(30.0), InPlane(120.0), Vector3d::UnitZ();
  const DirectionEvidence evidence = MakeEvidence({InPlane(30.0), InPlane(-60.0)}, {InPlane(0.0)});
  const ScoredAxes scored = Score(evidence, axes);
  EXPECT_EQ(scored.axes, axes);
  EXPECT_EQ(scored.num_lines, Vector3d(1.0, 1.0, 0.0));
  EXPECT_EQ(scored.num_normals, Vector3d::Zero().eval());
}

}  // namespace
}  // namespace msc_vo
