// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/geometry/so3.h"

#include <cmath>

namespace msc_vo {

Eigen::Matrix3d Skew(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

Eigen::Quaterniond ExpSO3(const Eigen::Vector3d& w) {
  const double square = 0.25 * w.squaredNorm();  // of the half angle
  double cosine, sinc;                           // of the half angle
  if (square < 1e-3) {  // the first terms of the Taylor series are accurate to double precision
    cosine =
        1.0 - square / 2.0 * (1.0 - square / 12.0 * (1.0 - square / 30.0 * (1.0 - square / 56.0)));
    sinc = 1.0 - square / 6.0 * (1.0 - square / 20.0 * (1.0 - square / 42.0));
  } else {
    const double half = std::sqrt(square);
    cosine = std::cos(half);
    sinc = std::sin(half) / half;
  }
  const Eigen::Vector3d v = 0.5 * sinc * w;
  return Eigen::Quaterniond(cosine, v.x(), v.y(), v.z()).normalized();
}

Eigen::Vector3d LogSO3(const Eigen::Quaterniond& q) {
  const double sign = q.w() < 0.0 ? -1.0 : 1.0;
  const Eigen::Vector3d v = sign * q.vec();
  const double sin_half = v.norm();
  const double half = std::atan2(sin_half, sign * q.w());
  return (sin_half < 1e-8 ? 2.0 : 2.0 * half / sin_half) * v;
}

Eigen::Matrix3d InverseLeftJacobianSO3(const Eigen::Vector3d& w) {
  const double angle = w.norm();
  // (1 - (a / 2) cot(a / 2)) / a^2: two Taylor terms are accurate to double precision below 1e-2,
  // where the difference suffers from cancellation.
  const double square_factor = angle < 1e-2
                                   ? 1.0 / 12.0 + angle * angle / 720.0
                                   : (1.0 - 0.5 * angle / std::tan(0.5 * angle)) / (angle * angle);
  const Eigen::Matrix3d cross = Skew(w);
  return Eigen::Matrix3d::Identity() - 0.5 * cross + square_factor * cross * cross;
}

}  // namespace msc_vo
