// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cmath>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace msc_vo {

/// Unit direction of a line block (start, end; 6 numbers), from start to end. Returns false for a
/// line of zero length, which has neither direction nor derivative.
template <typename T>
bool LineDirection(const T* line, Eigen::Matrix<T, 3, 1>* direction) {
  using std::sqrt;
  const Eigen::Matrix<T, 3, 1> d(line[3] - line[0], line[4] - line[1], line[5] - line[2]);
  const T squared = d.squaredNorm();
  if (!(squared > 0.0)) return false;
  *direction = d / sqrt(squared);
  return true;
}

/// d direction / d(end - start) = (I - d d^T) / |end - start|, 1/metres.
inline Eigen::Matrix3d LineDirectionJacobian(const double* line) {
  const Eigen::Vector3d v(line[3] - line[0], line[4] - line[1], line[5] - line[2]);
  const double length = v.norm();
  const Eigen::Vector3d d = v / length;
  return (Eigen::Matrix3d::Identity() - d * d.transpose()) / length;
}

}  // namespace msc_vo
