// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "tests/support/factor_checks.h"

#include <cmath>

#include "tests/support/eigen_matchers.h"
#include <ceres/solver.h>

#include "msc_vo/factors/jacobian_check.h"
#include "msc_vo/geometry/so3.h"

namespace msc_vo {

std::vector<const double*> Pointers(const Blocks& blocks) {
  std::vector<const double*> pointers;
  for (const auto& block : blocks) pointers.push_back(block.data());
  return pointers;
}

Eigen::VectorXd Residual(const ceres::CostFunction& cost, const Blocks& blocks) {
  Eigen::VectorXd residual(cost.num_residuals());
  EXPECT_TRUE(cost.Evaluate(Pointers(blocks).data(), residual.data(), nullptr));
  return residual;
}

bool IsDefined(const ceres::CostFunction& cost, const Blocks& blocks) {
  Eigen::VectorXd residual(cost.num_residuals());
  return cost.Evaluate(Pointers(blocks).data(), residual.data(), nullptr);
}

Linearization Linearize(const ceres::CostFunction& cost, const Blocks& blocks) {
  Linearization at;
  at.residual.resize(cost.num_residuals());
  std::vector<double*> jacobians;
  for (const auto& block : blocks) at.jacobians.emplace_back(cost.num_residuals(), block.size());
  for (auto& jacobian : at.jacobians) jacobians.push_back(jacobian.data());
  EXPECT_TRUE(cost.Evaluate(Pointers(blocks).data(), at.residual.data(), jacobians.data()));
  return at;
}

void ExpectEachJacobianSeparately(const ceres::CostFunction& cost, const Blocks& blocks) {
  const Linearization all = Linearize(cost, blocks);
  for (size_t k = 0; k < blocks.size(); ++k) {
    Linearization one = all;
    one.jacobians[k].setZero();
    std::vector<double*> jacobians(blocks.size(), nullptr);
    jacobians[k] = one.jacobians[k].data();
    EXPECT_TRUE(cost.Evaluate(Pointers(blocks).data(), one.residual.data(), jacobians.data()));
    EXPECT_EQ(one.jacobians[k], all.jacobians[k]);
  }
}

void ExpectGradientsMatch(const ceres::CostFunction& cost, const Blocks& blocks,
                          const ceres::Manifold* manifold) {
  static const Rigid3Manifold pose_manifold;
  std::vector<const ceres::Manifold*> manifolds;
  for (const auto& block : blocks) {
    manifolds.push_back(block.size() == 7 ? &pose_manifold : manifold);
  }
  const JacobianCheck check = CheckJacobians(cost, blocks, manifolds);
  EXPECT_LT(check.deviation, 1e-7) << check.report;
}

void ExpectSameCostFunction(const ceres::CostFunction& analytic,
                            const ceres::CostFunction& automatic, const Blocks& blocks) {
  const Linearization a = Linearize(automatic, blocks);
  const Linearization b = Linearize(analytic, blocks);
  // Relative to the norm: the two round differently.
  EXPECT_THAT(b.residual, IsNear(a.residual, 1e-12 * (1e3 + a.residual.norm())));
  EXPECT_THAT(Residual(analytic, blocks), IsNear(a.residual, 1e-12));
  for (size_t i = 0; i < blocks.size(); ++i) {
    EXPECT_THAT(b.jacobians[i], IsNear(a.jacobians[i], 1e-12 * (1.0 + a.jacobians[i].norm())));
  }
}

void ExpectIdentityCovariance(const std::vector<Eigen::VectorXd>& samples) {
  const auto dim = samples.front().size();
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(dim, dim);
  for (const auto& r : samples) covariance += r * r.transpose() / double(samples.size());
  const double tolerance = 5.0 * std::sqrt(2.0 / double(samples.size()));
  EXPECT_THAT(covariance, IsNear(Eigen::MatrixXd::Identity(dim, dim), tolerance));
}

void SolveToEnd(ceres::Problem* problem) {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  options.max_num_iterations = 100;
  options.function_tolerance = 1e-30;
  options.gradient_tolerance = 1e-14;
  options.parameter_tolerance = 1e-14;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, problem, &summary);
  EXPECT_TRUE(summary.IsSolutionUsable()) << summary.FullReport();
}

Rigid3 Moved(const Rigid3& pose, const Eigen::Vector3d& w, const Eigen::Vector3d& u) {
  return {ExpSO3(w) * pose.rotation(), pose.translation() + u};
}

double Distance(const Rigid3& a, const Rigid3& b) {
  Eigen::Matrix<double, 6, 1> difference;
  Rigid3Manifold().Minus(a.params.data(), b.params.data(), difference.data());
  return difference.norm();
}

}  // namespace msc_vo
