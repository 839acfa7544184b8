// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/pose_estimation/plane_factors.h"

#include <algorithm>
#include <memory>

#include <ceres/loss_function.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include "msc_vo/factors/chi_square.h"
#include "msc_vo/factors/plane_manifold.h"
#include "msc_vo/factors/plane_observation.h"

namespace msc_vo {

namespace {

// A PlaneObservation of a plane that is held fixed, 3 rows. Poses that are tried far from the truth
// may be behind the plane: there the factor is constant, and beyond every test.
class FixedPlaneObservation : public CostFunctor<FixedPlaneObservation, 3, 7> {
 public:
  FixedPlaneObservation(const PlaneObservation& observation, const Plane& plane)
      : observation_(observation), plane_(plane) {}

  template <typename T>
  bool operator()(const T* cam_from_world, T* residuals) const {
    const Eigen::Matrix<T, 4, 1> plane = plane_.params.cast<T>();
    if (observation_(cam_from_world, plane.data(), residuals)) return true;
    std::fill(residuals, residuals + kNumResiduals, T(1e3));
    return true;
  }

 private:
  PlaneObservation observation_;
  Plane plane_;
};

// A PlaneObservation from a pose that is held fixed, 3 rows.
class PlaneFromFixedPose : public CostFunctor<PlaneFromFixedPose, 3, 4> {
 public:
  PlaneFromFixedPose(const PlaneObservation& observation, const Rigid3& cam_from_world)
      : observation_(observation), cam_from_world_(cam_from_world) {}

  template <typename T>
  bool operator()(const T* plane, T* residuals) const {
    const Eigen::Matrix<T, 7, 1> pose = cam_from_world_.params.cast<T>();
    return observation_(pose.data(), plane, residuals);
  }

 private:
  PlaneObservation observation_;
  Rigid3 cam_from_world_;
};

// Errors of focal lengths and principal point, in focal lengths: they tilt all planes but those
// across the axis. Twice those of a camera that counts as calibrated (calibration_evidence.cc), as
// all frames have them in common, and nothing averages them.
constexpr double kCalibrationError = 0.01;

PlaneObservation Observe(const PlaneFeature& feature, double noise, PlanesBeside beside) {
  const Eigen::Vector3d& q = feature.inverse_depth;
  Eigen::Matrix3d covariance = noise * noise * feature.covariance;
  if (beside == PlanesBeside::kPointsAndLines) {
    const Eigen::Vector3d tilt(q.x(), q.y(), q.head<2>().norm());
    covariance.diagonal() += (kCalibrationError * tilt).cwiseAbs2();
  }
  return {q, covariance};
}

const std::shared_ptr<const ceres::LossFunction>& Loss() {
  static const std::shared_ptr<const ceres::LossFunction> loss =
      std::make_shared<ceres::HuberLoss>(kHuberThreshold[3]);
  return loss;
}

}  // namespace

std::vector<PoseFactor> MakePlanePoseFactors(const std::vector<PlaneFeature>& features,
                                             const std::vector<PlaneMatch>& matches,
                                             const MapPlanes& map, PlanesBeside beside) {
  std::vector<PoseFactor> factors;
  for (const PlaneMatch& match : matches) {
    const PlaneLandmark* plane = map.Find(match.plane);
    if (plane == nullptr) continue;
    factors.push_back({"plane",
                       FixedPlaneObservation::CreateShared(
                           Observe(features[match.feature], map.noise, beside), plane->plane),
                       Loss()});
  }
  return factors;
}

CustomFactor MakePlaneFactor(const PlaneFeature& feature, double noise, const BlockId& pose,
                             const BlockId& plane) {
  return {"plane",
          PlaneObservation::CreateShared(Observe(feature, noise, PlanesBeside::kPointsAndLines)),
          Loss(),
          {pose, plane}};
}

void FitPlane(const std::vector<PlaneView>& views, double noise, Plane* plane) {
  constexpr int kMaxIterations = 10;  // steps of Newton's method, which begins nearby
  Plane fitted = *plane;
  ceres::HuberLoss loss(kHuberThreshold[3]);
  ceres::Problem::Options ownership;
  ownership.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(ownership);
  problem.AddParameterBlock(fitted.params.data(), 4, new PlaneManifold());
  for (const PlaneView& view : views) {
    const PlaneFromFixedPose factor(Observe(*view.feature, noise, PlanesBeside::kNothing),
                                    view.cam_from_world);
    Eigen::Vector3d residual;
    if (!factor(plane->params.data(), residual.data())) continue;  // behind the camera
    problem.AddResidualBlock(PlaneFromFixedPose::Create(factor), &loss, fitted.params.data());
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = kMaxIterations;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (summary.IsSolutionUsable()) *plane = fitted;
}

}  // namespace msc_vo
