// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/structure/axes_refinement.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

#include <Eigen/Eigenvalues>
#include <ceres/loss_function.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include "msc_vo/bundle_adjustment/validation.h"
#include "msc_vo/factors/chi_square.h"
#include "msc_vo/factors/manhattan_rotation.h"
#include "msc_vo/factors/rotation3_manifold.h"

namespace msc_vo {

namespace {

using Observation = ManhattanAxesData::Observation;

// Rounds of optimisation and reclassification of all observations, outliers of earlier rounds
// included. The first round uses all observations, so that a poor start rejects none. Stops early
// once the classification is stable.
constexpr int kMaxRounds = 5;
constexpr int kIterationsPerRound = 10;
// Smallest number of inliers: twelve equations for three unknowns.
constexpr int kMinInliers = 6;

const char* ObservationError(const Observation& o) {
  if (UnitVectorError(o.direction) != nullptr) return "direction is not a unit vector";
  if (o.axis < 0 || o.axis > 2) return "axis must be 0, 1 or 2";
  if (UnitVectorError(o.normal) != nullptr || std::abs(o.normal.dot(o.direction)) > 1e-6) {
    return "normal is not a unit vector perpendicular to the direction";
  }
  if (!(std::isfinite(o.sigma) && o.sigma > 0.0)) return "sigma must be positive";
  if (!(std::isfinite(o.normal_sigma) && o.normal_sigma > 0.0)) {
    return "normal_sigma must be positive";
  }
  return nullptr;
}

void Validate(const ManhattanAxesData& data) {
  const auto fail = [](const std::string& what) {
    throw std::invalid_argument("RefineManhattanAxes: " + what);
  };
  if (PoseError(Rigid3(data.world_from_manhattan, Eigen::Vector3d::Zero())) != nullptr) {
    fail("world_from_manhattan is not a unit quaternion");
  }
  for (size_t i = 0; i < data.observations.size(); ++i) {
    const char* what = ObservationError(data.observations[i]);
    if (what != nullptr) fail("observation " + std::to_string(i) + ": " + what);
  }
}

ManhattanRotation MakeFactor(const Observation& o) {
  return ManhattanRotation(o.direction, o.normal, o.axis, o.sigma, o.normal_sigma);
}

double ChiSquare(const Observation& o, const Eigen::Quaterniond& world_from_manhattan) {
  Eigen::Vector2d r;
  MakeFactor(o)(world_from_manhattan.coeffs().data(), r.data());
  return r.squaredNorm();
}

std::vector<bool> Classify(const ManhattanAxesData& data,
                           const Eigen::Quaterniond& world_from_manhattan) {
  std::vector<bool> inliers;
  for (const Observation& o : data.observations) {
    inliers.push_back(ChiSquare(o, world_from_manhattan) <= kOutlierChiSquare[2]);
  }
  return inliers;
}

// One round of optimisation over the inliers. The observed directions fix the gauge.
bool Minimize(const ManhattanAxesData& data, const std::vector<bool>& inliers,
              Eigen::Quaterniond* world_from_manhattan) {
  double* block = world_from_manhattan->coeffs().data();
  ceres::Problem problem;
  problem.AddParameterBlock(block, 4, new Rotation3Manifold);
  for (size_t i = 0; i < inliers.size(); ++i) {
    if (!inliers[i]) continue;
    const Observation& o = data.observations[i];
    problem.AddResidualBlock(ManhattanRotation::Create(MakeFactor(o)),
                             new ceres::HuberLoss(kHuberThreshold[2]), block);
  }
  ceres::Solver::Options solver;
  solver.max_num_iterations = kIterationsPerRound;
  solver.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;  // three unknowns
  solver.num_threads = 1;
  solver.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(solver, &problem, &summary);
  return summary.IsSolutionUsable() && world_from_manhattan->coeffs().allFinite();
}

// Sum of J^T J over the inliers, linearised at directions that coincide with their axis m. One
// direction contributes p p^T / sigma_n^2 + n n^T / sigma^2, where m, n (the normal) and p are an
// orthonormal basis; it does not constrain the rotation about m. At the measured directions, J^T J
// would contain spurious information about that rotation from noise alone.
Eigen::Matrix3d Information(const ManhattanAxesData& data, const std::vector<bool>& inliers,
                            const Eigen::Quaterniond& world_from_manhattan) {
  const Eigen::Matrix3d axes = world_from_manhattan.toRotationMatrix();
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  for (size_t i = 0; i < inliers.size(); ++i) {
    if (!inliers[i]) continue;
    const Observation& o = data.observations[i];
    const Eigen::Vector3d m = axes.col(o.axis);
    const Eigen::Vector3d p = m.cross(o.normal).normalized();
    const Eigen::Vector3d n = p.cross(m);
    information += p * p.transpose() / (o.normal_sigma * o.normal_sigma) +
                   n * n.transpose() / (o.sigma * o.sigma);
  }
  return information;
}

// Fills in inliers and covariance. The result is usable if the information has full rank.
void Summarize(const ManhattanAxesData& data, const std::vector<bool>& inliers,
               const Eigen::Quaterniond& world_from_manhattan, ManhattanAxesSummary* summary) {
  summary->num_inliers = static_cast<int>(std::count(inliers.begin(), inliers.end(), true));
  if (summary->num_inliers < kMinInliers) return;
  const Eigen::Matrix3d information = Information(data, inliers, world_from_manhattan);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(information);
  // With one axis the information is singular up to rounding. A single observation of a second axis
  // among a million of the first gives a ratio of 1e-6.
  if (!(eigen.eigenvalues()[0] > 1e-10 * eigen.eigenvalues()[2])) return;
  double chi_square = 0.0;
  for (size_t i = 0; i < inliers.size(); ++i) {
    if (inliers[i]) chi_square += ChiSquare(data.observations[i], world_from_manhattan);
  }
  const double inflation = std::max(1.0, chi_square / (2.0 * summary->num_inliers - 3.0));
  summary->covariance = inflation * information.inverse();
  summary->usable = true;
}

}  // namespace

ManhattanAxesSummary RefineManhattanAxes(ManhattanAxesData* data) {
  Validate(*data);
  Eigen::Quaterniond world_from_manhattan = data->world_from_manhattan;
  std::vector<bool> inliers(data->observations.size(), true);
  ManhattanAxesSummary summary;
  bool solved = true;
  for (int round = 0; round < kMaxRounds && solved; ++round) {
    solved = Minimize(*data, inliers, &world_from_manhattan);
    std::vector<bool> next = Classify(*data, world_from_manhattan);
    const bool is_stable = next == inliers;
    inliers = std::move(next);
    if (is_stable) break;
  }
  for (size_t i = 0; i < inliers.size(); ++i) data->observations[i].inlier = inliers[i];
  if (solved) Summarize(*data, inliers, world_from_manhattan, &summary);
  if (summary.usable) data->world_from_manhattan = world_from_manhattan;
  return summary;
}

}  // namespace msc_vo
