// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/pose_estimation/plane_pose_factor.h"

#include <algorithm>
#include <memory>

#include <ceres/loss_function.h>

#include "msc_vo/factors/chi_square.h"
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

}  // namespace

std::vector<PoseFactor> MakePlanePoseFactors(const std::vector<PlaneFeature>& features,
                                             const std::vector<PlaneMatch>& matches,
                                             const MapPlanes& map) {
  static const auto loss = std::make_shared<const ceres::HuberLoss>(kHuberThreshold[3]);
  std::vector<PoseFactor> factors;
  for (const PlaneMatch& match : matches) {
    const PlaneLandmark* plane = map.Find(match.plane);
    if (plane == nullptr) continue;
    const PlaneFeature& feature = features[match.feature];
    const PlaneObservation observation(feature.inverse_depth,
                                       map.noise * map.noise * feature.covariance);
    factors.push_back(
        {"plane", FixedPlaneObservation::CreateShared(observation, plane->plane), loss});
  }
  return factors;
}

}  // namespace msc_vo
