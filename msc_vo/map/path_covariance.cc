// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/map/path_covariance.h"

#include <algorithm>

#include <Eigen/Cholesky>

#include "msc_vo/factors/chi_square.h"
#include "msc_vo/geometry/angles.h"
#include "msc_vo/geometry/so3.h"

namespace msc_vo {

namespace {

// Variance of a step relative to that of the pose, which holds the landmarks for exact: they err as
// well, and neighbours share their errors, so that those of the steps add up faster.
constexpr double kStepScale = 4.0;
// What errors of the calibration and of the depth sensor add, which are the same in every step: per
// metre of the path. Both are measured, see docs/lab/loops.md.
constexpr double kSystematicSigma = 0.005;                           // metres
constexpr double kSystematicRotationSigma = DegreesToRadians(0.05);  // radians

}  // namespace

PoseCovariance PathCovariance(const Map& map, KeyframeId a, KeyframeId b) {
  const Rigid3 b_from_world = map.CamFromWorld(b);
  PoseCovariance sum = PoseCovariance::Zero();
  const KeyframeId first = std::min(a, b), last = std::max(a, b);
  Rigid3 before_from_world = map.CamFromWorld(first);
  double length = 0.0;
  for (KeyframeId id = first + 1; id <= last; ++id) {
    const PoseCovariance* step = map.StepCovariance(id);
    if (step == nullptr) continue;
    const Rigid3 step_from_world = map.CamFromWorld(id);
    length += (step_from_world * before_from_world.Inverse()).translation().norm();
    before_from_world = step_from_world;
    sum += TransportCovariance(b_from_world * step_from_world.Inverse(), kStepScale * *step);
  }
  return sum + IsotropicCovariance(kSystematicRotationSigma * length, kSystematicSigma * length);
}

bool IsPossibleDrift(const Map& map, KeyframeId a, KeyframeId b, const Rigid3& by_path,
                     const Rigid3& measured, const PoseCovariance& covariance) {
  const Rigid3 error = by_path * measured.Inverse();
  Eigen::Matrix<double, 6, 1> tangent;
  tangent << LogSO3(error.rotation()), error.translation();
  const PoseCovariance sum = covariance + PathCovariance(map, a, b);
  return tangent.dot(sum.ldlt().solve(tangent)) < kOutlierChiSquare[6];
}

}  // namespace msc_vo
