// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/geometry/rigid_alignment.h"

#include <random>
#include <stdexcept>

#include "tests/geometry/alignment_truth.h"
#include "tests/support/eigen_matchers.h"
#include <gtest/gtest.h>

#include "msc_vo/geometry/so3.h"

namespace msc_vo {
namespace {

std::vector<Eigen::Vector3d> Cloud(int count, const Eigen::Vector3d& size, unsigned seed) {
  std::mt19937 engine(seed);
  std::normal_distribution<double> normal;
  std::vector<Eigen::Vector3d> cloud;
  for (int i = 0; i < count; ++i) {
    const double x = normal(engine), y = normal(engine), z = normal(engine);
    cloud.push_back(size.cwiseProduct(Eigen::Vector3d(x, y, z)));
  }
  return cloud;
}

std::vector<Eigen::Vector3d> Transformed(const Rigid3& b_from_a,
                                         std::vector<Eigen::Vector3d> cloud) {
  for (Eigen::Vector3d& x : cloud) x = b_from_a * x;
  return cloud;
}

double SumOfSquares(const Rigid3& pose, const std::vector<Eigen::Vector3d>& source,
                    const std::vector<Eigen::Vector3d>& target) {
  double sum = 0.0;
  for (size_t i = 0; i < source.size(); ++i) sum += (target[i] - pose * source[i]).squaredNorm();
  return sum;
}

TEST(AlignRigid, RecoversTransform) {
  const auto source = Cloud(20, {1.0, 2.0, 0.5}, 1);
  const Rigid3 pose = AlignRigid(source, Transformed(kTruth, source));
  EXPECT_NEAR(SumOfSquares(pose, source, Transformed(kTruth, source)), 0.0, 1e-24);
}

TEST(AlignRigid, RecoversTransformFromCoplanarPoints) {
  // The correlation has rank two: a reflection fits equally well and must not be returned.
  for (unsigned seed = 1; seed < 10; ++seed) {
    const auto source = Cloud(10, {1.0, 2.0, 0.0}, seed);
    const Rigid3 pose = AlignRigid(source, Transformed(kTruth, source));
    EXPECT_NEAR(pose.rotation().norm(), 1.0, 1e-12);
    EXPECT_THAT(pose * Eigen::Vector3d(0.1, 0.2, 5.0),
                IsNear(kTruth * Eigen::Vector3d(0.1, 0.2, 5.0), 1e-9));
  }
}

TEST(AlignRigid, ReturnsRotationForReflectedPoints) {
  const auto source = Cloud(20, {1.0, 2.0, 0.5}, 2);
  auto mirrored = source;
  for (Eigen::Vector3d& x : mirrored) x.z() = -x.z();
  const Rigid3 pose = AlignRigid(source, mirrored);
  EXPECT_NEAR(pose.rotation().toRotationMatrix().determinant(), 1.0, 1e-12);
  // No rotation fits; the best one has errors along the direction of smallest extent only.
  double thinnest = 0.0;
  for (const Eigen::Vector3d& x : source) thinnest += 4.0 * x.z() * x.z();
  EXPECT_LE(SumOfSquares(pose, source, mirrored), thinnest);
  EXPECT_GT(SumOfSquares(pose, source, mirrored), 0.1);
}

TEST(AlignRigid, MinimisesSquaredDistances) {
  const auto source = Cloud(20, {1.0, 2.0, 0.5}, 3);
  auto target = Transformed(kTruth, source);
  const auto noise = Cloud(20, {0.1, 0.1, 0.1}, 4);
  for (size_t i = 0; i < target.size(); ++i) target[i] += noise[i];
  const Rigid3 best = AlignRigid(source, target);
  const double least = SumOfSquares(best, source, target);
  for (int axis = 0; axis < 3; ++axis) {
    for (const double step : {-1e-3, 1e-3}) {
      const Eigen::Vector3d d = step * Eigen::Vector3d::Unit(axis);
      const Rigid3 turned(ExpSO3(d) * best.rotation(), best.translation());
      const Rigid3 shifted(best.rotation(), best.translation() + d);
      EXPECT_GT(SumOfSquares(turned, source, target), least);
      EXPECT_GT(SumOfSquares(shifted, source, target), least);
    }
  }
}

TEST(AlignPoses, RecoversTransformFromOnePose) {
  const Rigid3 pose(ExpSO3({-0.4, 0.2, 2.0}), {0.5, 0.1, -3.0});
  const Rigid3 found = AlignPoses({pose}, {kTruth * pose});
  EXPECT_LT(found.rotation().angularDistance(kTruth.rotation()), 1e-9);
  EXPECT_THAT(found.translation(), IsNear(Eigen::Vector3d(kTruth.translation()), 1e-12));
}

TEST(AlignPoses, AveragesOrientations) {
  // The mean of rotations by plus and minus 0.1 about each axis is the identity.
  std::vector<Rigid3> source, target;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double turn : {-0.1, 0.1}) {
      const Rigid3 pose(ExpSO3({0.3 * axis, 1.0, -0.5}), {1.0 * axis, turn, 2.0});
      source.push_back(pose);
      target.push_back(kTruth * Rigid3(ExpSO3(turn * Eigen::Vector3d::Unit(axis)) * pose.rotation(),
                                       pose.translation()));
    }
  }
  const Rigid3 found = AlignPoses(source, target);
  EXPECT_LT(found.rotation().angularDistance(kTruth.rotation()), 1e-9);
  EXPECT_THAT(found.translation(), IsNear(Eigen::Vector3d(kTruth.translation()), 1e-12));
}

TEST(AlignPoses, ThrowsOnInvalidPairs) {
  EXPECT_THROW(AlignPoses({}, {}), std::invalid_argument);
  EXPECT_THROW(AlignPoses({kTruth}, {}), std::invalid_argument);
}

TEST(AlignRigid, ThrowsOnInvalidPairs) {
  const auto cloud = Cloud(5, {1.0, 1.0, 1.0}, 5);
  EXPECT_THROW(AlignRigid(cloud, Cloud(4, {1.0, 1.0, 1.0}, 5)), std::invalid_argument);
  EXPECT_THROW(AlignRigid({cloud[0], cloud[1]}, {cloud[0], cloud[1]}), std::invalid_argument);
}

}  // namespace
}  // namespace msc_vo
