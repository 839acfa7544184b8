// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/geometry/so3.h"

#include "tests/support/eigen_matchers.h"
#include <gtest/gtest.h>

#include "msc_vo/geometry/angles.h"

namespace msc_vo {
namespace {

TEST(SO3, SkewIsCrossProduct) {
  const Eigen::Vector3d a(1.0, 2.0, 3.0), b(-2.0, 0.5, 4.0);
  EXPECT_THAT(Skew(a) * b, IsNear(a.cross(b), 1e-15));
}

TEST(SO3, ExpRotatesByNormAboutDirection) {
  const Eigen::Quaterniond quarter = ExpSO3({0.0, 0.0, 0.5 * kPi});
  EXPECT_THAT(quarter * Eigen::Vector3d::UnitX(), IsNear(Eigen::Vector3d::UnitY(), 1e-15));
  const Eigen::Vector3d w(0.3, -0.7, 0.2);
  EXPECT_THAT(ExpSO3(w).toRotationMatrix(),
              IsNear(Eigen::AngleAxisd(w.norm(), w.normalized()).toRotationMatrix(), 1e-15));
}

TEST(SO3, LogInvertsExpForAnyAngle) {
  const Eigen::Vector3d axis = Eigen::Vector3d(0.2, -0.5, 0.8).normalized();
  for (const double angle : {0.0, 1e-12, 1e-8, 1.9e-4, 2.1e-4, 0.1, 1.0, 3.0, kPi - 1e-7}) {
    const Eigen::Vector3d w = angle * axis;
    EXPECT_THAT(LogSO3(ExpSO3(w)), IsNear(w, 1e-14 + 1e-12 * angle)) << angle;
    EXPECT_NEAR(ExpSO3(w).norm(), 1.0, 1e-15);
  }
}

TEST(SO3, LogReturnsAngleBelowPi) {
  const Eigen::Quaterniond q = ExpSO3({0.3, 0.1, -0.2});
  EXPECT_THAT(LogSO3(Eigen::Quaterniond(-q.coeffs())),
              IsNear(Eigen::Vector3d(0.3, 0.1, -0.2), 1e-14));
  EXPECT_THAT(LogSO3(ExpSO3({0.0, 0.0, 1.5 * kPi})),
              IsNear(Eigen::Vector3d(0.0, 0.0, -0.5 * kPi), 1e-14));
}

TEST(SO3, InverseLeftJacobianIsDerivativeOfLeftPerturbation) {
  const Eigen::Vector3d axis = Eigen::Vector3d(0.2, -0.5, 0.8).normalized();
  for (const double angle : {0.0, 1e-6, 9e-3, 1.1e-2, 1.0, 3.0}) {
    const Eigen::Quaterniond q = ExpSO3(angle * axis);
    Eigen::Matrix3d numeric;
    const double h = 1e-6;
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d d = h * Eigen::Vector3d::Unit(i);
      numeric.col(i) = (LogSO3(ExpSO3(d) * q) - LogSO3(ExpSO3(-d) * q)) / (2.0 * h);
    }
    EXPECT_THAT(InverseLeftJacobianSO3(angle * axis), IsNear(numeric, 1e-8)) << angle;
  }
}

}  // namespace
}  // namespace msc_vo
