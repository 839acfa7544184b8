// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>
#include <random>
#include <vector>

#include "tests/support/eigen_matchers.h"
#include <ceres/cost_function.h>
#include <ceres/problem.h>
#include <gtest/gtest.h>

#include "msc_vo/factors/analytic_cost_function.h"
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

std::vector<const double*> Pointers(const Blocks& blocks);

// Evaluates the residual and expects success.
Eigen::VectorXd Residual(const ceres::CostFunction& cost, const Blocks& blocks);

bool IsDefined(const ceres::CostFunction& cost, const Blocks& blocks);

// Residual and Jacobians with respect to all ambient coordinates.
struct Linearization {
  Eigen::VectorXd residual;
  std::vector<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> jacobians;
};

Linearization Linearize(const ceres::CostFunction& cost, const Blocks& blocks);

// Asks for the Jacobian of one block at a time, as Ceres does if the others are constant.
void ExpectEachJacobianSeparately(const ceres::CostFunction& cost, const Blocks& blocks);

// Compares analytic with numeric derivatives in tangent space. Blocks of size 7 are poses;
// `manifold` is that of the other blocks.
void ExpectGradientsMatch(const ceres::CostFunction& cost, const Blocks& blocks,
                          const ceres::Manifold* manifold = nullptr);

// Compares a cost function with analytic derivatives with the automatically differentiated one.
void ExpectSameCostFunction(const ceres::CostFunction& analytic,
                            const ceres::CostFunction& automatic, const Blocks& blocks);

template <typename Factor>
void ExpectAnalyticMatchesAutomatic(const Factor& factor, const Blocks& blocks) {
  ExpectSameCostFunction(AnalyticCostFunction<Factor>(factor), *CostPtr(Factor::Create(factor)),
                         blocks);
}

// Compares the covariance of samples with the identity, within five standard errors.
void ExpectIdentityCovariance(const std::vector<Eigen::VectorXd>& samples);

// Solves a small problem to machine precision.
void SolveToEnd(ceres::Problem* problem);

// Adds a rotation vector (radians) and a translation (metres) as Rigid3Manifold does.
Rigid3 Moved(const Rigid3& pose, const Eigen::Vector3d& w, const Eigen::Vector3d& u);

inline LineSegment3 Swapped(const LineSegment3& line) { return {line.end, line.start}; }

// Norm of the difference of two poses, rotation vector (radians) and translation (metres).
double Distance(const Rigid3& a, const Rigid3& b);

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
