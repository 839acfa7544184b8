// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cmath>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace msc_vo {

constexpr double kPi = 3.14159265358979323846;

constexpr double DegreesToRadians(double degrees) { return degrees * (kPi / 180.0); }
constexpr double RadiansToDegrees(double radians) { return radians * (180.0 / kPi); }

/// Angle in [0, pi/2] between two undirected directions in space, which may have any non-zero
/// length. Accurate near 0 and pi/2, unlike the arc cosine of a dot product.
inline double UndirectedAngle(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), std::abs(a.dot(b)));
}

/// Angle in [0, pi/2] between two undirected directions in the image.
inline double UndirectedAngle(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return std::atan2(std::abs(a.x() * b.y() - a.y() * b.x()), std::abs(a.dot(b)));
}

}  // namespace msc_vo
