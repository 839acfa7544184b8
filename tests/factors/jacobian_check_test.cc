// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/factors/jacobian_check.h"

#include "tests/support/message_matchers.h"
#include <ceres/sized_cost_function.h>
#include <gmock/gmock.h>

#include "msc_vo/factors/rigid3_manifold.h"

namespace msc_vo {
namespace {

using testing::HasSubstr;

// r = a b over two blocks of size 1, with a derivative by b that is wrong by `error`.
class Product : public ceres::SizedCostFunction<1, 1, 1> {
 public:
  explicit Product(double error) : error_(error) {}
  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override {
    const double a = blocks[0][0], b = blocks[1][0];
    if (a < 0.0) return false;
    residuals[0] = a * b;
    if (jacobians && jacobians[0]) jacobians[0][0] = b;
    if (jacobians && jacobians[1]) jacobians[1][0] = a + error_;
    return true;
  }

 private:
  double error_;
};

// The norm of the quaternion of a pose, which no step in tangent space changes. Its derivative is
// wrong along the quaternion itself.
class QuaternionNorm : public ceres::SizedCostFunction<1, 7> {
 public:
  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override {
    const Eigen::Map<const Eigen::Vector4d> q(blocks[0]);
    residuals[0] = q.squaredNorm();
    if (jacobians && jacobians[0]) {
      Eigen::Map<Eigen::Matrix<double, 1, 7>>(jacobians[0]) << 5.0 * q.transpose(), 0.0, 0.0, 0.0;
    }
    return true;
  }
};

std::string MessageOf(const std::vector<std::vector<double>>& parameters,
                      const std::vector<const ceres::Manifold*>& manifolds) {
  try {
    CheckJacobians(Product(0.0), parameters, manifolds);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(JacobianCheck, AcceptsRightDerivatives) {
  const JacobianCheck check = CheckJacobians(Product(0.0), {{2.0}, {3.0}}, {nullptr, nullptr});
  EXPECT_LT(check.deviation, 1e-9);
}

TEST(JacobianCheck, FindsTheBlockWithAWrongDerivative) {
  const JacobianCheck check = CheckJacobians(Product(0.25), {{2.0}, {3.0}}, {nullptr, nullptr});
  EXPECT_NEAR(check.deviation, 0.25 / (1.0 + 2.25), 1e-9);
  EXPECT_THAT(check.report, Names("block 1"));
  EXPECT_THAT(check.report, HasSubstr("2.25"));
}

TEST(JacobianCheck, DetectsASmallError) {
  EXPECT_GT(CheckJacobians(Product(1e-6), {{2.0}, {3.0}}, {nullptr, nullptr}).deviation, 1e-7);
}

TEST(JacobianCheck, ComparesInTangentSpace) {
  const Rigid3Manifold pose;
  const std::vector<std::vector<double>> at = {{0.5, -0.5, 0.5, 0.5, 1.0, 2.0, 3.0}};
  EXPECT_LT(CheckJacobians(QuaternionNorm(), at, {&pose}).deviation, 1e-9);
  EXPECT_GT(CheckJacobians(QuaternionNorm(), at, {nullptr}).deviation, 0.1);
}

TEST(JacobianCheck, IsInfiniteWhereTheFactorIsUndefined) {
  const JacobianCheck check = CheckJacobians(Product(0.0), {{-1.0}, {3.0}}, {nullptr, nullptr});
  EXPECT_EQ(check.deviation, std::numeric_limits<double>::infinity());
  EXPECT_NE(check.report, "");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(CheckJacobians(Product(nan), {{1.0}, {3.0}}, {nullptr, nullptr}).deviation,
            std::numeric_limits<double>::infinity());
}

TEST(JacobianCheck, RejectsParametersThatDoNotFit) {
  const Rigid3Manifold pose;
  EXPECT_THAT(MessageOf({{1.0}}, {nullptr, nullptr}), Names("parameter blocks", "1", "2"));
  EXPECT_THAT(MessageOf({{1.0}, {1.0}}, {}), Names("manifolds", "0"));
  EXPECT_THAT(MessageOf({{1.0}, {1.0, 2.0}}, {nullptr, nullptr}), Names("block 1", "2"));
  EXPECT_THAT(MessageOf({{1.0}, {1.0}}, {&pose, nullptr}), Names("manifold", "block 0", "7"));
}

}  // namespace
}  // namespace msc_vo
