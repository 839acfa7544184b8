// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/pose_estimation/pose_factors.h"

#include <cmath>

#include <Eigen/Cholesky>

#include "msc_vo/factors/rigid3_manifold.h"

namespace msc_vo {

namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;

Rigid3 Plus(const Rigid3& pose, const Vector6& delta) {
  Rigid3 sum;
  Rigid3Manifold().Plus(pose.params.data(), delta.data(), sum.params.data());
  return sum;
}

// A step this short, squared and in units of the estimate's own standard deviation, is the last.
// Steps shrink at least tenfold here, so that it leaves 0.3 % of a deviation undone: the errors of
// kitchen and living change by less than 2e-5 mm from those with 1e-6, for a sixth less time.
constexpr double kSmallStep = 1e-3;

// Huber's rho(s) of a squared norm s, and rho'(s).
struct Loss {
  double rho;
  double weight;
};
Loss Huber(double huber, double s) {
  if (huber == 0.0 || s <= huber * huber) return {s, 1.0};
  const double norm = std::sqrt(s);
  return {2.0 * huber * norm - huber * huber, huber / norm};
}

}  // namespace

template <typename Factor>
bool PoseTerm<Factor>::AddTo(const Rigid3& cam_from_world, NormalEquations* sum) const {
  constexpr int kRows = Factor::kRowsPerPoint;
  const Eigen::Matrix3d rotation = cam_from_world.rotation().toRotationMatrix();
  const Eigen::Vector3d translation = cam_from_world.translation();
  Eigen::Matrix<double, Factor::kNumResiduals, 1> r;
  Eigen::Matrix<double, Factor::kNumResiduals, 6> j;
  for (const Block& block : blocks) {
    for (int k = 0; k < Factor::kNumPoints; ++k) {
      const Eigen::Vector3d rotated = rotation * block.x_in_world[k];
      const Eigen::Vector3d x_in_cam = rotated + translation;
      if (!(x_in_cam.z() >= kMinCameraDepth)) return false;
      Eigen::Matrix<double, kRows, 3> g;
      LinearizeInCamera(block.factor, k, x_in_cam, &r[k * kRows], &g);
      // x = Exp(w) R X + t + u: dx/dw = -[R X]x, dx/du = I.
      for (int i = 0; i < kRows; ++i) {
        const Eigen::Vector3d row = g.row(i);
        j.row(k * kRows + i) << rotated.cross(row).transpose(), row.transpose();
      }
    }
    const Loss loss = Huber(huber, r.squaredNorm());
    sum->cost += 0.5 * loss.rho;
    sum->gradient += loss.weight * (j.transpose() * r);
    for (int column = 0; column < 6; ++column) {
      for (int row = column; row < 6; ++row) {
        sum->hessian(row, column) += loss.weight * j.col(row).dot(j.col(column));
      }
    }
  }
  return true;
}

template <typename Factor>
bool PoseTerm<Factor>::AddCostTo(const Rigid3& cam_from_world, double* sum) const {
  const Eigen::Matrix3d rotation = cam_from_world.rotation().toRotationMatrix();
  const Eigen::Vector3d translation = cam_from_world.translation();
  Eigen::Matrix<double, Factor::kNumResiduals, 1> r;
  for (const Block& block : blocks) {
    for (int k = 0; k < Factor::kNumPoints; ++k) {
      const Eigen::Vector3d x_in_cam = rotation * block.x_in_world[k] + translation;
      if (!(x_in_cam.z() >= kMinCameraDepth)) return false;
      block.factor.Residual(k, x_in_cam, &r[k * Factor::kRowsPerPoint]);
    }
    *sum += 0.5 * Huber(huber, r.squaredNorm()).rho;
  }
  return true;
}

int PoseFactors::NumRows() const {
  return point_reprojection.NumRows() + point_depth.NumRows() + line_reprojection.NumRows() +
         line_depth.NumRows();
}

void PoseFactors::Clear() {
  point_reprojection.blocks.clear();
  point_depth.blocks.clear();
  line_reprojection.blocks.clear();
  line_depth.blocks.clear();
}

bool PoseFactors::Linearize(const Rigid3& cam_from_world, NormalEquations* equations) const {
  *equations = NormalEquations();
  if (!(point_reprojection.AddTo(cam_from_world, equations) &&
        point_depth.AddTo(cam_from_world, equations) &&
        line_reprojection.AddTo(cam_from_world, equations) &&
        line_depth.AddTo(cam_from_world, equations))) {
    return false;
  }
  equations->hessian.triangularView<Eigen::StrictlyUpper>() = equations->hessian.transpose();
  return std::isfinite(equations->cost);
}

bool PoseFactors::Cost(const Rigid3& cam_from_world, double* cost) const {
  *cost = 0.0;
  return point_reprojection.AddCostTo(cam_from_world, cost) &&
         point_depth.AddCostTo(cam_from_world, cost) &&
         line_reprojection.AddCostTo(cam_from_world, cost) &&
         line_depth.AddCostTo(cam_from_world, cost) && std::isfinite(*cost);
}

PoseTermination MinimizePose(const PoseFactors& factors, int max_iterations,
                             Rigid3* cam_from_world) {
  NormalEquations at;
  if (!factors.Linearize(*cam_from_world, &at)) return PoseTermination::kFailed;
  // Damping relative to the diagonal, as Marquardt; small, as predictions are good.
  double lambda = 1e-4;
  for (int i = 0; i < max_iterations; ++i) {
    Eigen::Matrix<double, 6, 6> damped = at.hessian;
    damped.diagonal() *= 1.0 + lambda;
    // Not every direction needs to be seen: a tiny absolute term holds the others where they are.
    damped.diagonal().array() += 1e-12 * at.hessian.trace();
    const Vector6 step = -damped.ldlt().solve(at.gradient);
    if (!step.allFinite()) return PoseTermination::kFailed;
    const Rigid3 candidate = Plus(*cam_from_world, step);
    // No further step needs derivatives. At the minimum, rounding may refuse this one.
    if (step.dot(at.hessian * step) < kSmallStep) {
      double cost;
      if (factors.Cost(candidate, &cost) && cost <= at.cost) *cam_from_world = candidate;
      return PoseTermination::kConverged;
    }
    NormalEquations next;
    if (factors.Linearize(candidate, &next) && next.cost <= at.cost) {
      *cam_from_world = candidate;
      at = next;
      lambda *= 0.1;
    } else {
      lambda *= 100.0;
    }
  }
  return PoseTermination::kIterationLimit;
}

template struct PoseTerm<PointReprojection>;
template struct PoseTerm<DepthReprojection>;
template struct PoseTerm<LineReprojection>;
template struct PoseTerm<LineDepthReprojection>;

}  // namespace msc_vo
