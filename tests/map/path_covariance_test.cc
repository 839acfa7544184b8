// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/map/path_covariance.h"

#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include "msc_vo/geometry/so3.h"

namespace msc_vo {
namespace {

constexpr double kRotationVariance = 1e-6, kVariance = 1e-4;  // of a step, radians^2 and m^2

// Keyframes at 1 m from each other on a straight line along x, which all look along z.
class PathCovarianceTest : public testing::Test {
 protected:
  PathCovarianceTest() {
    PoseCovariance step = PoseCovariance::Zero();
    step.diagonal().head<3>().setConstant(kRotationVariance);
    step.diagonal().tail<3>().setConstant(kVariance);
    for (int i = 0; i < 12; ++i) {
      map_.AddKeyframe(std::make_shared<Frame>(), CameraAt(i));
      map_.SetStepCovariance(i, step);
    }
  }
  static Rigid3 CameraAt(double x) { return {Eigen::Quaterniond::Identity(), {-x, 0.0, 0.0}}; }
  double Along(int a, int b) const { return PathCovariance(map_, a, b)(3, 3); }
  double Across(int a, int b) const { return PathCovariance(map_, a, b)(4, 4); }

  Map map_;
};

TEST_F(PathCovarianceTest, GrowsWithEveryStep) {
  EXPECT_EQ(PathCovariance(map_, 5, 5), PoseCovariance::Zero());
  const double step = Along(5, 6);
  EXPECT_GE(step, kVariance);  // the landmarks err, too
  for (int i = 2; i < 7; ++i) {
    EXPECT_GE(Along(5, 5 + i), i * step) << i;  // at least if all errors are independent
    EXPECT_LE(Along(5, 5 + i), i * i * step) << i;
  }
}

// Early errors of the orientation have the longest lever.
TEST_F(PathCovarianceTest, GrowsFasterAcrossThePath) {
  for (int i = 2; i < 10; ++i) {
    const double by_lever = kRotationVariance * i * i * i / 3.0 * 0.5;
    EXPECT_GE(Across(0, i), Along(0, i) + by_lever) << i;
  }
}

TEST_F(PathCovarianceTest, IsThatOfTheSameStepsInBothDirections) {
  const Rigid3 b_from_a = map_.CamFromWorld(9) * map_.CamFromWorld(2).Inverse();
  const PoseCovariance forwards = PathCovariance(map_, 2, 9);
  const PoseCovariance backwards = TransportCovariance(b_from_a, PathCovariance(map_, 9, 2));
  EXPECT_TRUE((backwards.topLeftCorner<3, 3>().isApprox(forwards.topLeftCorner<3, 3>(), 1e-9)));
  EXPECT_NEAR(backwards(3, 3), forwards(3, 3), 1e-9);
}

TEST_F(PathCovarianceTest, CountsKeyframesThatWereCulled) {
  const PoseCovariance before = PathCovariance(map_, 1, 8);
  map_.RemoveKeyframe(4, 5);
  map_.RemoveKeyframe(5, 6);
  EXPECT_TRUE(PathCovariance(map_, 1, 8).isApprox(before, 1e-9));
}

TEST_F(PathCovarianceTest, BoundsTheDrift) {
  const Rigid3 by_path = map_.CamFromWorld(10) * map_.CamFromWorld(0).Inverse();
  const PoseCovariance none = PoseCovariance::Zero();
  const auto is_possible = [&](const Rigid3& error, const PoseCovariance& covariance) {
    return IsPossibleDrift(map_, 0, 10, by_path, error * by_path, covariance);
  };
  const auto shift = [](double metres) {
    return Rigid3(Eigen::Quaterniond::Identity(), {metres, 0.0, 0.0});
  };
  const double sigma = std::sqrt(Along(0, 10));
  EXPECT_TRUE(is_possible(shift(0.0), none));
  EXPECT_TRUE(is_possible(shift(2.0 * sigma), none));
  EXPECT_FALSE(is_possible(shift(6.0 * sigma), none));
  EXPECT_FALSE(is_possible({ExpSO3({0.0, 0.5, 0.0}), Eigen::Vector3d::Zero()}, none));
  // An inexact measurement allows more.
  EXPECT_TRUE(is_possible(shift(6.0 * sigma), 9.0 * Along(0, 10) * PoseCovariance::Identity()));
}

}  // namespace
}  // namespace msc_vo
