// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/pose_estimation/pose_factors.h"

#include <cmath>
#include <vector>

#include <Eigen/Cholesky>

#include "msc_vo/bundle_adjustment/custom_linearization.h"
#include "msc_vo/factors/camera_linearization.h"
#include "msc_vo/factors/rigid3_manifold.h"
#include "msc_vo/factors/robust_loss.h"
#include "msc_vo/pose_estimation/row_sum.h"

namespace msc_vo {

namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;

Rigid3 Plus(const Rigid3& pose, const Vector6& delta) {
  Rigid3 sum;
  Rigid3Manifold().Plus(pose.params.data(), delta.data(), sum.params.data());
  return sum;
}

std::vector<CustomParameter> ParametersOf(const Rigid3& pose) {
  static const Rigid3Manifold manifold;
  return {{pose.params.data(), 7, &manifold, true}};
}

// Adds to the whole Hessian. Returns false if the factor fails or is not finite.
bool AddTo(const PoseFactor& factor, const Rigid3& pose, NormalEquations* sum) {
  CustomLinearization at;
  if (!LinearizeCustomFactor(*factor.cost, factor.loss.get(), ParametersOf(pose), &at)) {
    return false;
  }
  const Eigen::MatrixXd& j = at.jacobians[0];
  sum->cost += at.cost;
  sum->gradient += j.transpose() * at.residual;
  sum->hessian += j.transpose() * j;
  return true;
}

// The unknown pose and its normal equations, for MinimizeByLevenbergMarquardt.
class PoseProblem {
 public:
  PoseProblem(const PoseFactors& factors, const Rigid3& pose) : factors_(factors), pose_(pose) {}

  const Rigid3& pose() const { return pose_; }

  bool Linearize() { return factors_.Linearize(pose_, &at_); }

  bool SolveStep(double lambda, double* squared_step) {
    Eigen::Matrix<double, 6, 6> damped = at_.hessian;
    damped.diagonal() *= 1.0 + lambda;
    // A small absolute term determines directions that no factor constrains.
    damped.diagonal().array() += 1e-12 * at_.hessian.trace();
    const Vector6 step = -damped.ldlt().solve(at_.gradient);
    if (!step.allFinite()) return false;
    candidate_ = Plus(pose_, step);
    *squared_step = step.dot(at_.hessian * step);
    return true;
  }

  bool TakeStep(bool is_last) {
    NormalEquations next;
    const bool is_defined =
        is_last ? factors_.Cost(candidate_, &next.cost) : factors_.Linearize(candidate_, &next);
    if (!is_defined || !(next.cost <= at_.cost)) return false;
    pose_ = candidate_;
    at_ = next;
    return true;
  }

 private:
  const PoseFactors& factors_;
  Rigid3 pose_, candidate_;
  NormalEquations at_;
};

}  // namespace

template <typename Factor>
bool PoseTerm<Factor>::AddTo(const Rigid3& cam_from_world, NormalEquations* sum) const {
  constexpr int kRows = Factor::kRowsPerPoint;
  const Eigen::Matrix3d rotation = cam_from_world.rotation().toRotationMatrix();
  const Eigen::Vector3d translation = cam_from_world.translation();
  const HuberLoss loss{huber};
  CameraPoints<Factor::kNumPoints> points;
  RowSum rows;
  for (const Block& block : blocks) {
    if (!points.Set(block.factor, rotation, translation, block.landmark.data())) return false;
    const CameraLinearization<Factor> at = LinearizeInCamera(block.factor, points);
    const double s = at.residual.squaredNorm();
    const double weight = loss.Weight(s);
    sum->cost += 0.5 * loss.Cost(s);
    for (int row = 0; row < Factor::kNumResiduals; ++row) {
      const int k = row / kRows;
      rows.Add(points.rotated[k], at.by_x[k].row(row % kRows), at.residual[row], weight);
    }
  }
  rows.AddTo(&sum->hessian, &sum->gradient);
  return true;
}

template <typename Factor>
bool PoseTerm<Factor>::AddCostTo(const Rigid3& cam_from_world, double* sum) const {
  const Eigen::Matrix3d rotation = cam_from_world.rotation().toRotationMatrix();
  const Eigen::Vector3d translation = cam_from_world.translation();
  const HuberLoss loss{huber};
  CameraPoints<Factor::kNumPoints> points;
  for (const Block& block : blocks) {
    if (!points.Set(block.factor, rotation, translation, block.landmark.data())) return false;
    *sum += 0.5 * loss.Cost(ResidualInCamera(block.factor, points.x).squaredNorm());
  }
  return true;
}

int PoseFactors::NumRows() const {
  int num_rows = std::apply([](const auto&... term) { return (term.NumRows() + ...); }, terms);
  for (const PoseFactor& factor : custom) num_rows += factor.cost->num_residuals();
  return num_rows;
}

void PoseFactors::Clear() {
  std::apply([](auto&... term) { (term.blocks.clear(), ...); }, terms);
  custom.clear();
}

bool PoseFactors::Linearize(const Rigid3& cam_from_world, NormalEquations* equations) const {
  *equations = NormalEquations();
  const auto add = [&](const auto&... term) {
    return (term.AddTo(cam_from_world, equations) && ...);
  };
  if (!std::apply(add, terms)) return false;
  equations->hessian.triangularView<Eigen::StrictlyUpper>() = equations->hessian.transpose();
  for (const PoseFactor& factor : custom) {
    if (!AddTo(factor, cam_from_world, equations)) return false;
  }
  return std::isfinite(equations->cost);
}

bool PoseFactors::Cost(const Rigid3& cam_from_world, double* cost) const {
  *cost = 0.0;
  const auto add = [&](const auto&... term) {
    return (term.AddCostTo(cam_from_world, cost) && ...);
  };
  if (!std::apply(add, terms)) return false;
  // Derivatives included: a cost function may round its residual differently without them.
  NormalEquations of_custom;
  of_custom.cost = *cost;
  for (const PoseFactor& factor : custom) {
    if (!AddTo(factor, cam_from_world, &of_custom)) return false;
  }
  *cost = of_custom.cost;
  return std::isfinite(*cost);
}

std::string PoseFactorError(const PoseFactor& factor, const Rigid3& cam_from_world) {
  return CustomFactorError(factor.cost.get(), factor.loss.get(), ParametersOf(cam_from_world),
                           {"the pose of the frame"});
}

LevenbergMarquardtTermination MinimizePose(const PoseFactors& factors, int max_iterations,
                                           Rigid3* cam_from_world) {
  // Steps shrink at least tenfold, so a step of this squared length leaves an error of 0.3 % of a
  // standard deviation. Chosen by measurement, see docs/lab/tracking.md.
  constexpr double kMinSquaredStep = 1e-3;
  PoseProblem problem(factors, *cam_from_world);
  const LevenbergMarquardtTermination termination =
      MinimizeByLevenbergMarquardt(max_iterations, kMinSquaredStep, &problem).termination;
  if (termination != LevenbergMarquardtTermination::kFailed) *cam_from_world = problem.pose();
  return termination;
}

}  // namespace msc_vo
