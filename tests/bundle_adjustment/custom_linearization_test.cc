// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/bundle_adjustment/custom_linearization.h"

#include <array>
#include <cmath>
#include <limits>

#include "tests/support/eigen_matchers.h"
#include <ceres/loss_function.h>
#include <ceres/sized_cost_function.h>
#include <ceres/sphere_manifold.h>
#include <gtest/gtest.h>

namespace msc_vo {
namespace {

// r = (a_0 - b_0, 2 a_1 b_1) over two blocks of size 3.
class TwoRows : public ceres::SizedCostFunction<2, 3, 3> {
 public:
  bool Evaluate(const double* const* x, double* r, double** jacobians) const override {
    const double *a = x[0], *b = x[1];
    r[0] = a[0] - b[0];
    r[1] = 2.0 * a[1] * b[1];
    const double by_a[6] = {1.0, 0.0, 0.0, 0.0, 2.0 * b[1], 0.0};
    const double by_b[6] = {-1.0, 0.0, 0.0, 0.0, 2.0 * a[1], 0.0};
    if (jacobians != nullptr && jacobians[0] != nullptr) std::copy_n(by_a, 6, jacobians[0]);
    if (jacobians != nullptr && jacobians[1] != nullptr) std::copy_n(by_b, 6, jacobians[1]);
    return true;
  }
};

// rho(s) = -s rewards large residuals.
class Reward : public ceres::LossFunction {
  void Evaluate(double s, double* rho) const override {
    rho[0] = -s;
    rho[1] = -1.0;
    rho[2] = 0.0;
  }
};

class CustomLinearizationTest : public ::testing::Test {
 protected:
  bool Linearize(const ceres::LossFunction* loss) {
    return LinearizeCustomFactor(cost_, loss, parameters_, &at_);
  }

  TwoRows cost_;
  std::array<double, 3> a_{0.6, 0.8, 0.0}, b_{-0.4, 5.0, 1.0};  // r = (1, 8)
  std::vector<CustomParameter> parameters_{{a_.data(), 3, nullptr, true},
                                           {b_.data(), 3, nullptr, true}};
  CustomLinearization at_;
};

TEST_F(CustomLinearizationTest, WeightsRowsByTheLoss) {
  const ceres::HuberLoss loss(2.0);
  ASSERT_TRUE(Linearize(&loss));
  const double norm = std::sqrt(65.0), root = std::sqrt(2.0 / norm);  // |r|, sqrt(rho')
  EXPECT_NEAR(at_.cost, 2.0 * norm - 2.0, 1e-12);                     // rho / 2 = t |r| - t^2 / 2
  EXPECT_EQ(at_.cost, CustomFactorCost(cost_, &loss, parameters_));
  EXPECT_THAT(at_.residual, IsNear(root * Eigen::Vector2d(1.0, 8.0), 1e-12));
  Eigen::Matrix<double, 2, 3> by_b;
  by_b << -1.0, 0.0, 0.0, 0.0, 1.6, 0.0;
  EXPECT_THAT(at_.jacobians[1], IsNear(root * by_b, 1e-12));
}

TEST_F(CustomLinearizationTest, DifferentiatesInTheTangentSpaceOfVariableBlocks) {
  const ceres::SphereManifold<3> sphere;
  parameters_[0].manifold = &sphere;
  parameters_[1].variable = false;
  ASSERT_TRUE(Linearize(nullptr));
  EXPECT_EQ(at_.jacobians[1].size(), 0);
  Eigen::Matrix<double, 2, 3> by_a;
  by_a << 1.0, 0.0, 0.0, 0.0, 10.0, 0.0;
  Eigen::Matrix<double, 3, 2, Eigen::RowMajor> plus;
  sphere.PlusJacobian(a_.data(), plus.data());
  const Eigen::Matrix2d expected = by_a * plus;
  EXPECT_THAT(at_.jacobians[0], IsNear(expected, 1e-12));
}

TEST_F(CustomLinearizationTest, ALossCannotRewardAResidual) {
  const Reward loss;
  ASSERT_TRUE(Linearize(&loss));
  EXPECT_EQ(at_.residual.norm(), 0.0);
  EXPECT_EQ(at_.jacobians[0].norm(), 0.0);
}

// The cost of Tukey's loss is finite there, and the weight is zero.
TEST_F(CustomLinearizationTest, IsUndefinedWhereTheResidualIsInfinite) {
  const ceres::TukeyLoss loss(1.0);
  EXPECT_TRUE(Linearize(&loss));
  a_[0] = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(Linearize(&loss));
  EXPECT_TRUE(std::isnan(CustomFactorCost(cost_, &loss, parameters_)));
}

TEST_F(CustomLinearizationTest, DescribesTheError) {
  const std::vector<std::string> names{"a", "b"};
  EXPECT_EQ(CustomFactorError(&cost_, nullptr, parameters_, names), "");
  EXPECT_EQ(CustomFactorError(nullptr, nullptr, parameters_, names), "its cost function is null");
  parameters_[1].size = 4;
  EXPECT_EQ(CustomFactorError(&cost_, nullptr, parameters_, names),
            "its cost function has size 3 for parameter block 1, but b has size 4");
  parameters_.pop_back();
  EXPECT_EQ(CustomFactorError(&cost_, nullptr, parameters_, names),
            "the number of parameter blocks of its cost function is 2 instead of 1");
}

}  // namespace
}  // namespace msc_vo
