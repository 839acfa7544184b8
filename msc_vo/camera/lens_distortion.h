// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <array>

#include <Eigen/Core>

#include "msc_vo/camera/pinhole_camera.h"

namespace msc_vo {

/// Brown-Conrady lens distortion in OpenCV's order k1 k2 p1 p2 k3.
struct LensDistortion {
  std::array<double, 5> k = {0.0, 0.0, 0.0, 0.0, 0.0};

  /// Tests whether there is no distortion.
  bool IsZero() const { return k == std::array<double, 5>{}; }

  /// Distorts a point of the plane z = 1.
  Eigen::Vector2d DistortNormalized(const Eigen::Vector2d& x) const;
  /// Derivative of DistortNormalized() with respect to `x`; symmetric.
  Eigen::Matrix2d Jacobian(const Eigen::Vector2d& x) const;

  /// Returns the distorted pixel of an undistorted pixel of `camera`.
  Eigen::Vector2d Distort(const PinholeCamera& camera, const Eigen::Vector2d& pixel) const;
  /// Returns the undistorted pixel whose Distort() is `pixel`, to 1e-9 px. Uses fixed-point
  /// iteration, with a Newton step where that converges slowly or not at all; at most 100 steps.
  /// The result is finite for any lens, and correct for lenses that pass IsInvertible().
  Eigen::Vector2d Undistort(const PinholeCamera& camera, const Eigen::Vector2d& pixel) const;
};

}  // namespace msc_vo
