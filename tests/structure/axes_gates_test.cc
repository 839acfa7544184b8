// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/structure/internal/axes_gates.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "msc_vo/geometry/angles.h"

namespace msc_vo {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Evidence of the given numbers, of which the gates use the numbers alone, and axes with its
// support.
struct Support {
  size_t num_lines = 40;
  size_t num_normals = 400;
  ScoredAxes axes;

  Support(const Vector3d& lines, const Vector3d& normals) {
    axes.num_lines = lines;
    axes.num_normals = normals;
    axes.explained_ratio = 0.75;
  }
  bool Passes() const {
    DirectionEvidence evidence;
    evidence.num_lines = num_lines;
    evidence.all.resize(num_lines + num_normals);
    return PassesGates(evidence, axes);
  }
};

Support Room() { return {{16.0, 12.0, 4.0}, {100.0, 100.0, 100.0}}; }

TEST(AxesGates, AcceptsARoom) { EXPECT_TRUE(Room().Passes()); }

TEST(AxesGates, RequiresTheMajorityOfTheWeight) {
  Support support = Room();
  support.axes.explained_ratio = 0.49;
  EXPECT_FALSE(support.Passes());
}

TEST(AxesGates, RequiresTheMajorityOfNumerousLines) {
  Support support = Room();
  support.axes.num_lines = {7.0, 7.0, 5.0};
  EXPECT_FALSE(support.Passes());
  support.axes.num_lines = {7.0, 7.0, 6.0};
  EXPECT_TRUE(support.Passes());
  support.axes.num_lines = {3.0, 2.0, 2.0};
  support.num_lines = 19;  // too few for a test of lines alone
  EXPECT_TRUE(support.Passes());
}

TEST(AxesGates, RequiresTheMajorityOfNumerousNormals) {
  Support support = Room();
  support.axes.num_normals = {99.0, 100.0, 0.0};
  EXPECT_FALSE(support.Passes());
  support.axes.num_normals = {100.0, 100.0, 0.0};
  EXPECT_TRUE(support.Passes());
  support.axes.num_normals = {30.0, 30.0, 20.0};
  support.num_normals = 199;
  EXPECT_TRUE(support.Passes());
}

TEST(AxesGates, LimitsTheMisfitOfEveryAxis) {
  for (int axis = 0; axis < 3; ++axis) {
    Support support = Room();
    support.axes.misfit[axis] = kMaxMisfit + DegreesToRadians(0.1);
    EXPECT_FALSE(support.Passes()) << axis;
    support.axes.misfit[axis] = kMaxMisfit - DegreesToRadians(0.1);
    EXPECT_TRUE(support.Passes()) << axis;
  }
}

TEST(AxesGates, RequiresSurfacesAcrossTwoAxesOrLinesAlongThree) {
  // A rectangle: lines along two axes and the normals of one.
  EXPECT_FALSE(Support({20.0, 15.0, 0.0}, {0.0, 0.0, 300.0}).Passes());
  EXPECT_TRUE(Support({20.0, 15.0, 3.0}, {0.0, 0.0, 300.0}).Passes());
  EXPECT_TRUE(Support({20.0, 15.0, 0.0}, {0.0, 20.0, 280.0}).Passes());
  // Fewer than 3 lines or 5 % of the normals may be a coincidence.
  EXPECT_FALSE(Support({20.0, 15.0, 2.0}, {0.0, 0.0, 300.0}).Passes());
  EXPECT_FALSE(Support({20.0, 15.0, 0.0}, {0.0, 19.0, 281.0}).Passes());
}

TEST(AxesGates, RequiresSupportThatChanceDoesNotExplain) {
  Support few = Room();
  few.axes.num_lines.setZero();
  few.num_lines = 0;
  few.num_normals = 100;
  few.axes.num_normals = {50.0, 50.0, 0.0};
  EXPECT_TRUE(few.Passes());
  few.axes.num_normals = {30.0, 30.0, 0.0};
  EXPECT_FALSE(few.Passes());
  // Fewer than three independent observations always span axes.
  few.num_normals = 40;
  few.axes.num_normals = {20.0, 20.0, 0.0};
  EXPECT_FALSE(few.Passes());
}

// A building (axes x, y, z) and an annexe turned by `degrees` about the common vertical z. The
// annexe's walls have the given fraction of the weight of the building's walls.
struct Building {
  double degrees = 35.0;
  double annexe = 1.0;

  bool HasRival() const {
    const Matrix3d turn =
        Eigen::AngleAxisd(DegreesToRadians(degrees), Vector3d::UnitZ()).toRotationMatrix();
    DirectionEvidence evidence;
    evidence.all = {{Vector3d::UnitZ(), 10.0},
                    {Vector3d::UnitX(), 1.0},
                    {Vector3d::UnitY(), 1.0},
                    {turn.col(0), annexe},
                    {turn.col(1), annexe}};
    const std::vector<ScoredAxes> hypotheses = {ScoreAxes(evidence, Matrix3d::Identity()),
                                                ScoreAxes(evidence, turn)};
    return msc_vo::HasRival(evidence, hypotheses, Matrix3d::Identity());
  }
};

TEST(AxesRival, ComparesTheEvidenceThatIsNotShared) {
  EXPECT_TRUE((Building{35.0, 1.0}.HasRival()));
  EXPECT_TRUE((Building{35.0, kMaxRival + 0.01}.HasRival()));
  // The common vertical would make the hypotheses nearly equal.
  EXPECT_FALSE((Building{35.0, kMaxRival - 0.01}.HasRival()));
}

TEST(AxesRival, IgnoresHypothesesWithOverlappingCones) {
  const double min_angle = RadiansToDegrees(2.0 * kAxisCone);
  EXPECT_FALSE((Building{min_angle - 0.5, 1.0}.HasRival()));
  EXPECT_TRUE((Building{min_angle + 0.5, 1.0}.HasRival()));
}

}  // namespace
}  // namespace msc_vo
