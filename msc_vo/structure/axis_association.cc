// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/structure/axis_association.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace msc_vo {

bool AxisAssociationOptions::IsValid(std::string* error) const {
  if (!(max_sigmas > 0.0)) {
    *error = "max_sigmas must be positive";
  } else if (!(max_angle > 0.0 && max_angle < 45.0)) {
    *error = "max_angle must lie between 0 and 45 degrees: a line has one axis at most";
  } else if (!(max_sigma > 0.0)) {
    *error = "max_sigma must be positive (degrees)";
  } else if (!(min_probability >= 0.0 && min_probability <= 1.0)) {
    *error = "min_probability must lie in [0, 1]";
  } else {
    return true;
  }
  return false;
}

std::optional<int> AssociateAxis(const AxisAssociationOptions& options,
                                 const Eigen::Quaterniond& rotation, double rotation_sigma,
                                 const AxisEvidence& line) {
  std::string error;
  if (!options.IsValid(&error)) throw std::invalid_argument("AssociateAxis: " + error);
  if (!(line.sigma <= DegreesToRadians(options.max_sigma))) return std::nullopt;
  const Eigen::Vector3d direction = rotation.conjugate() * line.direction;
  int axis = 0;
  direction.cwiseAbs().maxCoeff(&axis);
  const double angle = UndirectedAngle(direction, Eigen::Vector3d(Eigen::Vector3d::Unit(axis)));
  const double gate = options.max_sigmas * std::hypot(line.sigma, rotation_sigma);
  if (!(angle <= std::min(gate, DegreesToRadians(options.max_angle)))) return std::nullopt;
  return axis;
}

std::optional<AxisCandidate> NearestAxis(const AxisAssociationOptions& options,
                                         const Eigen::Matrix3d& axes, double axes_sigma,
                                         const DirectionEstimate& line) {
  if (line.Sigma() > DegreesToRadians(options.max_sigma)) return std::nullopt;
  const Eigen::Vector3d direction = axes.transpose() * line.direction;
  int axis = 0;
  direction.cwiseAbs().maxCoeff(&axis);
  Eigen::Matrix<double, 3, 2> across;
  across << axes.col((axis + 1) % 3), axes.col((axis + 2) % 3);
  AxisCandidate candidate;
  candidate.axis = axis;
  candidate.deviation.angle = across.transpose() * line.direction / direction[axis];
  candidate.deviation.covariance = across.transpose() * line.covariance * across +
                                   axes_sigma * axes_sigma * Eigen::Matrix2d::Identity();
  if (candidate.deviation.angle.norm() > DegreesToRadians(options.max_angle)) return std::nullopt;
  return candidate;
}

}  // namespace msc_vo
