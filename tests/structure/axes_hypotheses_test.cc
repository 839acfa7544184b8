// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/structure/internal/axes_hypotheses.h"

#include <algorithm>

#include "tests/structure/evidence.h"
#include <gtest/gtest.h>

namespace msc_vo {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Matrix3d Yaw(double degrees) {
  return Eigen::AngleAxisd(DegreesToRadians(degrees), Vector3d::UnitZ()).toRotationMatrix();
}

std::vector<Matrix3d> Find(const testing::Evidence& lines) {
  return FindAxesHypotheses(GatherEvidence(lines, {}));
}

// Angle (degrees) between `axes` and the nearest hypothesis.
double NearestInDegrees(const std::vector<Matrix3d>& hypotheses, const Matrix3d& axes) {
  double nearest = kPi;
  for (const Matrix3d& other : hypotheses) {
    nearest = std::min(nearest, AngleBetweenAxes(other, axes));
  }
  return RadiansToDegrees(nearest);
}

TEST(AngleBetweenAxes, IgnoresOrderAndSigns) {
  const Matrix3d axes = Yaw(20.0);
  Matrix3d permuted;
  permuted << -axes.col(2), axes.col(0), -axes.col(1);
  EXPECT_LT(AngleBetweenAxes(axes, permuted), 1e-7);
}

TEST(AngleBetweenAxes, IsTheLargestAngleOfAnAxis) {
  EXPECT_NEAR(RadiansToDegrees(AngleBetweenAxes(Matrix3d::Identity(), Yaw(10.0))), 10.0, 1e-9);
  EXPECT_NEAR(RadiansToDegrees(AngleBetweenAxes(Matrix3d::Identity(), Yaw(80.0))), 10.0, 1e-9);
}

TEST(AxesHypotheses, AreSpannedByPerpendicularDirections) {
  Random random(1);
  testing::Evidence lines;
  testing::AddAlong(Vector3d::UnitX(), 20, DegreesToRadians(0.5), &random, &lines);
  testing::AddAlong(Vector3d::UnitY(), 20, DegreesToRadians(0.5), &random, &lines);
  const std::vector<Matrix3d> hypotheses = Find(lines);
  ASSERT_EQ(hypotheses.size(), 1u);
  EXPECT_LT(NearestInDegrees(hypotheses, Matrix3d::Identity()), 0.5);
}

TEST(AxesHypotheses, AreRotations) {
  Random random(2);
  const testing::View view = testing::RoomView(testing::RandomRotation(&random), 0.3, &random);
  const std::vector<Matrix3d> hypotheses = Find(view.lines);
  ASSERT_FALSE(hypotheses.empty());
  for (const Matrix3d& axes : hypotheses) {
    EXPECT_TRUE((axes.transpose() * axes).isIdentity(1e-9));
    EXPECT_NEAR(axes.determinant(), 1.0, 1e-9);
  }
}

TEST(AxesHypotheses, RequirePerpendicularDirections) {
  Random random(3);
  testing::Evidence lines;
  testing::AddAlong(Vector3d::UnitX(), 20, DegreesToRadians(0.5), &random, &lines);
  EXPECT_TRUE(Find(lines).empty());
  testing::AddAlong(Yaw(60.0) * Vector3d::UnitX(), 20, DegreesToRadians(0.5), &random, &lines);
  EXPECT_TRUE(Find(lines).empty());
}

TEST(AxesHypotheses, ContainBothFramesOfABuildingWithAnAnnexe) {
  Random random(4);
  testing::Evidence lines;
  for (const double yaw : {0.0, 35.0}) {
    for (int i = 0; i < 3; ++i) {
      testing::AddAlong(Yaw(yaw).col(i), 15, DegreesToRadians(0.5), &random, &lines);
    }
  }
  const std::vector<Matrix3d> hypotheses = Find(lines);
  EXPECT_LT(NearestInDegrees(hypotheses, Yaw(0.0)), 1.0);
  EXPECT_LT(NearestInDegrees(hypotheses, Yaw(35.0)), 1.0);
}

// A single mode has an error of its own; the mean shift uses the evidence of all axes.
TEST(AxesHypotheses, AreRefinedByTheEvidenceOfAllAxes) {
  Random random(5);
  double squares = 0.0;
  constexpr int kRuns = 20;
  for (int run = 0; run < kRuns; ++run) {
    const Eigen::Quaterniond truth = testing::RandomRotation(&random);
    testing::Evidence lines;
    for (int i = 0; i < 3; ++i) {
      testing::AddAlong(truth * Vector3d::Unit(i), 50, testing::kLineSigma, &random, &lines);
    }
    squares += std::pow(NearestInDegrees(Find(lines), truth.toRotationMatrix()), 2);
  }
  // 100 of 150 directions with a sigma of one degree constrain each component: 0.1 degrees.
  EXPECT_LT(std::sqrt(squares / kRuns), 0.25);
}

}  // namespace
}  // namespace msc_vo
