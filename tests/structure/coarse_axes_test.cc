// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/structure/coarse_axes.h"

#include <cmath>

#include "tests/structure/evidence.h"
#include <gtest/gtest.h>

namespace msc_vo {
namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using testing::AddClutter;
using testing::AddLines;
using testing::AddNormals;
using testing::AxesErrorInDegrees;
using testing::RandomDirection;
using testing::RandomRotation;
using testing::RoomView;
using testing::View;

std::optional<ManhattanAxes> Find(const View& view) {
  return FindCoarseAxes(view.lines, view.normals);
}

// Expects axes within one degree of `truth`.
void ExpectAxes(const View& view, const Quaterniond& truth) {
  const auto axes = Find(view);
  ASSERT_TRUE(axes);
  EXPECT_LT(AxesErrorInDegrees(axes->rotation, truth), 1.0);
}

class CoarseAxesInClutter : public ::testing::TestWithParam<double> {};

TEST_P(CoarseAxesInClutter, HaveErrorsBelowOneDegree) {
  for (uint64_t seed = 0; seed < 20; ++seed) {
    Random random(seed);
    const Quaterniond truth = RandomRotation(&random);
    const auto axes = Find(RoomView(truth, GetParam(), &random));
    ASSERT_TRUE(axes) << "seed " << seed;
    EXPECT_LT(AxesErrorInDegrees(axes->rotation, truth), 1.0) << "seed " << seed;
    EXPECT_NEAR(axes->explained_ratio, 1.0 - GetParam(), 0.08) << "seed " << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(ClutterRatio, CoarseAxesInClutter,
                         ::testing::Values(0.0, 0.1, 0.2, 0.3, 0.4));

TEST(CoarseAxes, RejectsAMajorityOfClutter) {
  for (uint64_t seed = 0; seed < 20; ++seed) {
    Random random(seed);
    EXPECT_FALSE(Find(RoomView(RandomRotation(&random), 0.6, &random))) << "seed " << seed;
  }
}

TEST(CoarseAxes, RejectsPureClutter) {
  for (uint64_t seed = 0; seed < 200; ++seed) {
    Random random(seed);
    View view;
    AddClutter(60, testing::kLineSigma, &random, &view.lines);
    AddClutter(400, testing::kNormalSigma, &random, &view.normals);
    EXPECT_FALSE(Find(view)) << "seed " << seed;
  }
}

// Among few directions, two that are perpendicular by chance can be a majority.
TEST(CoarseAxes, RejectsFewRandomDirections) {
  for (uint64_t seed = 0; seed < 1000; ++seed) {
    Random random(seed);
    View view;
    AddClutter(static_cast<int>(seed % 5), testing::kLineSigma, &random, &view.lines);
    AddClutter(2 + static_cast<int>(seed % 7), testing::kNormalSigma, &random, &view.normals);
    EXPECT_FALSE(Find(view)) << "seed " << seed;
  }
}

// A scene without Manhattan structure: four planes in random orientations and lines along their
// intersections. One in 100 may be accepted: two planes are perpendicular within the misfit in 7 %
// of all cases, and their evidence must have a majority as well.
TEST(CoarseAxes, RejectsMostScenesOfRandomPlanes) {
  int num_false_alarms = 0;
  for (uint64_t seed = 0; seed < 200; ++seed) {
    Random random(seed);
    View view;
    std::vector<Vector3d> planes;
    for (int i = 0; i < 4; ++i) {
      planes.push_back(RandomDirection(&random));
      AddNormals(planes.back(), 200, &random, &view);
      for (int j = 0; j < i; ++j) {
        AddLines(planes[i].cross(planes[j]).normalized(), 10, &random, &view);
      }
    }
    if (Find(view)) ++num_false_alarms;
  }
  EXPECT_LE(num_false_alarms, 2);
}

TEST(CoarseAxes, AcceptsTwoAxesOfLinesAndSurfaces) {
  Random random(3);
  const Quaterniond truth = RandomRotation(&random);
  const Matrix3d axes = truth.toRotationMatrix();
  View view;
  AddLines(axes.col(0), 30, &random, &view);
  AddLines(axes.col(1), 20, &random, &view);
  AddNormals(axes.col(0), 300, &random, &view);
  AddNormals(axes.col(1), 300, &random, &view);
  ExpectAxes(view, truth);
}

TEST(CoarseAxes, AcceptsLinesAlongThreeAxes) {
  Random random(4);
  const Quaterniond truth = RandomRotation(&random);
  View view;
  for (int i = 0; i < 3; ++i) AddLines(truth.toRotationMatrix().col(i), 10, &random, &view);
  ExpectAxes(view, truth);
}

TEST(CoarseAxes, AcceptsSurfacesAcrossTwoAxes) {
  Random random(5);
  const Quaterniond truth = RandomRotation(&random);
  View view;
  AddNormals(truth.toRotationMatrix().col(0), 400, &random, &view);
  AddNormals(truth.toRotationMatrix().col(2), 300, &random, &view);
  ExpectAxes(view, truth);
}

// For example a window in a sloped roof.
TEST(CoarseAxes, RejectsASingleRectangle) {
  Random random(6);
  const Matrix3d axes = RandomRotation(&random).toRotationMatrix();
  View view;
  AddLines(axes.col(0), 40, &random, &view);
  AddLines(axes.col(1), 40, &random, &view);
  AddNormals(axes.col(2), 800, &random, &view);
  EXPECT_FALSE(Find(view));
  AddNormals(axes.col(0), 100, &random, &view);  // surface across a second axis
  EXPECT_TRUE(Find(view));
}

TEST(CoarseAxes, RejectsASingleDirection) {
  Random random(7);
  View view;
  AddLines(Vector3d::UnitX(), 50, &random, &view);
  AddNormals(Vector3d::UnitY(), 500, &random, &view);
  EXPECT_FALSE(Find(view));
}

TEST(CoarseAxes, RejectsObliqueWalls) {
  for (const double degrees : {70.0, 80.0, 83.0}) {
    Random random(8);
    View view;
    const Vector3d wall(std::cos(DegreesToRadians(degrees)), std::sin(DegreesToRadians(degrees)),
                        0.0);
    AddNormals(Vector3d::UnitX(), 400, &random, &view);
    AddNormals(wall, 400, &random, &view);
    AddLines(Vector3d::UnitZ(), 30, &random, &view);
    EXPECT_FALSE(Find(view)) << degrees;
  }
}

// Two equal Manhattan frames with a common vertical explain two thirds of the evidence each.
TEST(CoarseAxes, RejectsTwoEqualFramesWithACommonVertical) {
  const auto house = [](int annexe_percent) {
    Random random(9);
    View view;
    for (const double yaw : {0.0, 35.0}) {
      const Eigen::AngleAxisd turn(DegreesToRadians(yaw), Vector3d::UnitZ());
      const int percent = yaw > 0.0 ? annexe_percent : 100;
      for (const Vector3d& axis : {Vector3d(turn * Vector3d::UnitX()), Vector3d::UnitZ().eval(),
                                   Vector3d(turn * Vector3d::UnitY())}) {
        AddLines(axis, percent / 5, &random, &view);
        AddNormals(axis, 2 * percent, &random, &view);
      }
    }
    return view;
  };
  EXPECT_FALSE(Find(house(100)));
  EXPECT_FALSE(Find(house(70)));
  ExpectAxes(house(25), Quaterniond::Identity());
}

TEST(CoarseAxes, IgnoresUncertainEvidence) {
  Random random(10);
  View view = RoomView(RandomRotation(&random), 0.0, &random);
  ASSERT_TRUE(Find(view));
  for (AxisEvidence& line : view.lines) line.sigma = DegreesToRadians(10.0);
  for (AxisEvidence& normal : view.normals) normal.sigma = DegreesToRadians(10.0);
  EXPECT_FALSE(Find(view));
}

TEST(CoarseAxes, RejectsEmptyEvidence) { EXPECT_FALSE(Find(View())); }

TEST(CoarseAxes, IsIndependentOfOrderAndSigns) {
  Random random(11);
  View view = RoomView(RandomRotation(&random), 0.3, &random);
  const auto first = Find(view);
  ASSERT_TRUE(first);
  const auto expect_same = [&](const ManhattanAxes& other) {
    EXPECT_EQ(other.rotation.coeffs(), first->rotation.coeffs());
    EXPECT_EQ(other.explained_ratio, first->explained_ratio);
  };
  expect_same(*Find(view));
  std::reverse(view.lines.begin(), view.lines.end());
  std::rotate(view.normals.begin(), view.normals.begin() + 123, view.normals.end());
  expect_same(*Find(view));
  for (AxisEvidence& line : view.lines) line.direction = -line.direction;
  const auto negated = Find(view);
  ASSERT_TRUE(negated);
  EXPECT_LT(negated->rotation.angularDistance(first->rotation), 1e-9);
}

TEST(CoarseAxes, RotatesWithTheEvidence) {
  Random random(12);
  View view = RoomView(RandomRotation(&random), 0.2, &random);
  const auto before = Find(view);
  ASSERT_TRUE(before);
  const Quaterniond turn = RandomRotation(&random);
  for (AxisEvidence& line : view.lines) line.direction = turn * line.direction;
  for (AxisEvidence& normal : view.normals) normal.direction = turn * normal.direction;
  const auto after = Find(view);
  ASSERT_TRUE(after);
  EXPECT_LT(AxesErrorInDegrees(after->rotation, turn * before->rotation), 0.01);
  // The mirror image of a room, as with a negative fy, is a room.
  for (AxisEvidence& line : view.lines) line.direction.y() *= -1.0;
  for (AxisEvidence& normal : view.normals) normal.direction.y() *= -1.0;
  const auto mirrored = Find(view);
  ASSERT_TRUE(mirrored);
  EXPECT_NEAR(mirrored->rotation.toRotationMatrix().determinant(), 1.0, 1e-12);
  const Matrix3d expected =
      Vector3d(1.0, -1.0, 1.0).asDiagonal() * after->rotation.toRotationMatrix();
  const Matrix3d cosines =
      (expected.transpose() * mirrored->rotation.toRotationMatrix()).cwiseAbs();
  EXPECT_GT(cosines.rowwise().maxCoeff().minCoeff(), 1.0 - 1e-6);
}

TEST(CoarseAxes, ReturnsTheOrderNearestToTheIdentity) {
  Random random(13);
  const Quaterniond truth(
      Eigen::AngleAxisd(DegreesToRadians(20.0), Vector3d(1, 2, 3).normalized()));
  const auto axes = Find(RoomView(truth, 0.0, &random));
  ASSERT_TRUE(axes);
  EXPECT_LT(RadiansToDegrees(axes->rotation.angularDistance(truth)), 1.0);
}

}  // namespace
}  // namespace msc_vo
