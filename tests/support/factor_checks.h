// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "tests/support/eigen_matchers.h"
#include <ceres/cost_function.h>
#include <ceres/problem.h>
#include <ceres/solver.h>
#include <gtest/gtest.h>

#include "msc_vo/factors/analytic_cost_function.h"
#include "msc_vo/factors/jacobian_check.h"
#include "msc_vo/factors/rigid3_manifold.h"
#include "msc_vo/geometry/line_segment.h"
#include "msc_vo/geometry/rigid3.h"

namespace msc_vo {

using CostPtr = std::unique_ptr<ceres::CostFunction>;
// Values of the parameter blocks in the factor's order.
using Blocks = std::vector<std::vector<double>>;

inline std::vector<double> Block(const Rigid3& pose) {
  return {pose.params.data(), pose.params.data() + 7};
}
inline std::vector<double> Block(const Eigen::Vector3d& x) { return {x.x(), x.y(), x.z()}; }
inline std::vector<double> Block(const LineSegment3& line) {
  return {line.start.data(), line.start.data() + 6};
}

inline std::vector<const double*> Pointers(const Blocks& blocks) {
  std::vector<const double*> pointers;
  for (const auto& block : blocks) pointers.push_back(block.data());
  return pointers;
}

// Evaluates the residual and expects success.
inline Eigen::VectorXd Residual(const ceres::CostFunction& cost, const Blocks& blocks) {
  Eigen::VectorXd residual(cost.num_residuals());
  EXPECT_TRUE(cost.Evaluate(Pointers(blocks).data(), residual.data(), nullptr));
  return residual;
}

inline bool IsDefined(const ceres::CostFunction& cost, const Blocks& blocks) {
  Eigen::VectorXd residual(cost.num_residuals());
  return cost.Evaluate(Pointers(blocks).data(), residual.data(), nullptr);
}

// Residual and Jacobians with respect to all ambient coordinates.
struct Linearization {
  Eigen::VectorXd residual;
  std::vector<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> jacobians;
};

inline Linearization Linearize(const ceres::CostFunction& cost, const Blocks& blocks) {
  Linearization at;
  at.residual.resize(cost.num_residuals());
  std::vector<double*> jacobians;
  for (const auto& block : blocks) at.jacobians.emplace_back(cost.num_residuals(), block.size());
  for (auto& jacobian : at.jacobians) jacobians.push_back(jacobian.data());
  EXPECT_TRUE(cost.Evaluate(Pointers(blocks).data(), at.residual.data(), jacobians.data()));
  return at;
}

// Asks for the Jacobian of one block at a time, as Ceres does if the others are constant.
inline void ExpectEachJacobianSeparately(const ceres::CostFunction& cost, const Blocks& blocks) {
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

// Compares analytic with numeric derivatives in tangent space. Blocks of size 7 are poses;
// `manifold` is that of the other blocks.
inline void ExpectGradientsMatch(const ceres::CostFunction& cost, const Blocks& blocks,
                                 const ceres::Manifold* manifold = nullptr) {
  static const Rigid3Manifold pose_manifold;
  std::vector<const ceres::Manifold*> manifolds;
  for (const auto& block : blocks) {
    manifolds.push_back(block.size() == 7 ? &pose_manifold : manifold);
  }
  const JacobianCheck check = CheckJacobians(cost, blocks, manifolds);
  EXPECT_LT(check.deviation, 1e-7) << check.report;
}

// Compares a cost function with analytic derivatives with the automatically differentiated one.
inline void ExpectSameCostFunction(const ceres::CostFunction& analytic,
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

template <typename Factor>
void ExpectAnalyticMatchesAutomatic(const Factor& factor, const Blocks& blocks) {
  ExpectSameCostFunction(AnalyticCostFunction<Factor>(factor), *CostPtr(Factor::Create(factor)),
                         blocks);
}

// Compares the covariance of samples with the identity, within five standard errors.
inline void ExpectIdentityCovariance(const std::vector<Eigen::VectorXd>& samples) {
  const auto dim = samples.front().size();
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(dim, dim);
  for (const auto& r : samples) covariance += r * r.transpose() / double(samples.size());
  const double tolerance = 5.0 * std::sqrt(2.0 / double(samples.size()));
  EXPECT_THAT(covariance, IsNear(Eigen::MatrixXd::Identity(dim, dim), tolerance));
}

// Solves a small problem to machine precision.
inline void SolveToEnd(ceres::Problem* problem) {
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

// Adds a rotation vector (radians) and a translation (metres) as Rigid3Manifold does.
inline Rigid3 Moved(const Rigid3& pose, const Eigen::Vector3d& w, const Eigen::Vector3d& u) {
  return {ExpSO3(w) * pose.rotation(), pose.translation() + u};
}

inline LineSegment3 Swapped(const LineSegment3& line) { return {line.end, line.start}; }

// Norm of the difference of two poses, rotation vector (radians) and translation (metres).
inline double Distance(const Rigid3& a, const Rigid3& b) {
  Eigen::Matrix<double, 6, 1> difference;
  Rigid3Manifold().Minus(a.params.data(), b.params.data(), difference.data());
  return difference.norm();
}

// Seeded random numbers, poses and lines.
class RandomGeometry {
 public:
  explicit RandomGeometry(unsigned seed) : engine_(seed) {}
  double Normal() { return normal_(engine_); }
  double Uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  Eigen::Vector2d Normal2() {
    const double x = Normal(), y = Normal();
    return {x, y};
  }
  Eigen::Vector3d Normal3() {
    const double x = Normal(), y = Normal(), z = Normal();
    return {x, y, z};
  }
  // A rotation of any size, and a translation of about one metre.
  Rigid3 Pose() {
    const Eigen::Vector3d w = Normal3(), t = Normal3();
    return {ExpSO3(w), t};
  }
  LineSegment3 Line() {
    const Eigen::Vector3d start = Normal3(), end = Normal3();
    return {start, end};
  }
  // A line parallel to d at a random position.
  LineSegment3 LineAlong(const Eigen::Vector3d& d) {
    const Eigen::Vector3d start = Normal3();
    return {start, start + Uniform(0.3, 3.0) * d};
  }
  // A point inside the image, in camera coordinates.
  Eigen::Vector3d InView() {
    const double z = Uniform(0.8, 6.0);
    const double x = Uniform(-0.5, 0.5), y = Uniform(-0.4, 0.4);
    return {z * x, z * y, z};
  }

 private:
  std::mt19937 engine_;
  std::normal_distribution<double> normal_;
};

}  // namespace msc_vo
