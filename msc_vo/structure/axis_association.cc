// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/structure/axis_association.h"

#include <algorithm>
#include <cmath>

namespace msc_vo {

std::optional<int> AssociateAxis(const Eigen::Quaterniond& rotation, double rotation_sigma,
                                 const AxisEvidence& line) {
  if (!(line.sigma <= kMaxAxisAngle)) return std::nullopt;
  const Eigen::Vector3d direction = rotation.conjugate() * line.direction;
  int axis = 0;
  direction.cwiseAbs().maxCoeff(&axis);
  const double angle = UndirectedAngle(direction, Eigen::Vector3d(Eigen::Vector3d::Unit(axis)));
  const double gate = kMaxAxisSigmas * std::hypot(line.sigma, rotation_sigma);
  if (!(angle <= std::min(gate, kMaxAxisAngle))) return std::nullopt;
  return axis;
}

std::optional<AxisCandidate> NearestAxis(double max_angle, const Eigen::Matrix3d& axes,
                                         double axes_sigma, const DirectionEstimate& line) {
  if (line.Sigma() > max_angle) return std::nullopt;
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
  if (candidate.deviation.angle.norm() > max_angle) return std::nullopt;
  return candidate;
}

}  // namespace msc_vo
