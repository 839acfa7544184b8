// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/pose_estimation/row_sum.h"

#include <random>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace msc_vo {
namespace {

// Fewer rows than are summed at a time, several times as many, and numbers that fill no vector.
TEST(RowSum, IsTheSumOverTheRows) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  const auto any = [&] { return Eigen::Vector3d(normal(random), normal(random), normal(random)); };
  for (const int count : {0, 1, 5, 64, 150}) {
    RowSum rows;
    Eigen::Matrix<double, 6, 6> hessian = Eigen::Matrix<double, 6, 6>::Identity();
    Eigen::Matrix<double, 6, 1> gradient = Eigen::Matrix<double, 6, 1>::Ones();
    Eigen::Matrix<double, 6, 6> expected_hessian = hessian;
    Eigen::Matrix<double, 6, 1> expected_gradient = gradient;
    for (int i = 0; i < count; ++i) {
      const Eigen::Vector3d x = any(), g = any();
      const double residual = normal(random), weight = std::abs(normal(random));
      rows.Add(x, g.transpose(), residual, weight);
      Eigen::Matrix<double, 6, 1> j;
      j << x.cross(g), g;
      expected_hessian += weight * j * j.transpose();
      expected_gradient += weight * residual * j;
    }
    rows.AddTo(&hessian, &gradient);
    for (int column = 0; column < 6; ++column) {
      EXPECT_NEAR(gradient[column], expected_gradient[column], 1e-10) << count;
      for (int row = column; row < 6; ++row) {
        EXPECT_NEAR(hessian(row, column), expected_hessian(row, column), 1e-10) << count;
      }
    }
    const Eigen::Matrix<double, 6, 6> before = hessian;
    rows.AddTo(&hessian, &gradient);  // nothing is left
    EXPECT_EQ(hessian, before);
  }
}

}  // namespace
}  // namespace msc_vo
