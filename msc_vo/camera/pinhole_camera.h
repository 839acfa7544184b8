// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cmath>
#include <string>

#include <Eigen/Core>

namespace msc_vo {

/// Pinhole camera without distortion: x right, y down, z forward; pixels, the centre of the upper
/// left pixel at (0, 0). fy may be negative (ICL-NUIM: mirrored images).
///
/// Features are undistorted when a frame is built, so everything after that uses this model alone.
/// LensDistortion describes the lens.
struct PinholeCamera {
  // All in pixels.
  double fx = 525.0;
  double fy = 525.0;
  double cx = 319.5;
  double cy = 239.5;
  int width = 640;
  int height = 480;

  /// Projects a point in camera coordinates (metres) to a pixel. Its z must be positive.
  Eigen::Vector2d Project(const Eigen::Vector3d& x_in_cam) const {
    return {fx * x_in_cam.x() / x_in_cam.z() + cx, fy * x_in_cam.y() / x_in_cam.z() + cy};
  }
  /// Returns the point with z = 1 on the viewing ray of `pixel`.
  Eigen::Vector3d Ray(const Eigen::Vector2d& pixel) const {
    return {(pixel.x() - cx) / fx, (pixel.y() - cy) / fy, 1.0};
  }
  /// Returns the point with z = `depth` (metres) on the viewing ray of `pixel`.
  Eigen::Vector3d BackProject(const Eigen::Vector2d& pixel, double depth) const {
    return depth * Ray(pixel);
  }
  /// Tests whether `pixel` is at least `margin` pixels inside the centres of the border pixels.
  bool IsInside(const Eigen::Vector2d& pixel, double margin = 0.0) const {
    return pixel.x() >= margin && pixel.y() >= margin && pixel.x() <= width - 1 - margin &&
           pixel.y() <= height - 1 - margin;
  }
  /// Mean of |fx| and |fy|, pixels: converts angles (radians) to pixels near the image centre.
  double FocalLength() const { return 0.5 * (std::abs(fx) + std::abs(fy)); }

  /// Tests whether the numbers are those of a camera. If not, `error` names the number and its
  /// valid range.
  bool IsValid(std::string* error) const;
};

}  // namespace msc_vo
