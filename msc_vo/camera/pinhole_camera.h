// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <array>
#include <cmath>
#include <string>

#include <Eigen/Core>

namespace msc_vo {

// An ideal pinhole camera: x right, y down, z forward; pixels, with the centre of the upper left
// pixel at (0, 0). A negative fy (ICL-NUIM, a mirrored image) is legal everywhere.
//
// Features are undistorted when a frame is built, so that everything behind the frame sees only
// this; the lens is described by LensDistortion beside it.
struct PinholeCamera {
  double fx = 525.0;
  double fy = 525.0;
  double cx = 319.5;
  double cy = 239.5;
  int width = 640;
  int height = 480;

  // Pixel of a point in camera coordinates (metres). Its z must be positive.
  Eigen::Vector2d Project(const Eigen::Vector3d& x_in_cam) const {
    return {fx * x_in_cam.x() / x_in_cam.z() + cx, fy * x_in_cam.y() / x_in_cam.z() + cy};
  }
  // The point on the ray of `pixel` with z = 1.
  Eigen::Vector3d Ray(const Eigen::Vector2d& pixel) const {
    return {(pixel.x() - cx) / fx, (pixel.y() - cy) / fy, 1.0};
  }
  // The point seen at `pixel` at z = `depth` metres (depth is z, not the length of the ray).
  Eigen::Vector3d BackProject(const Eigen::Vector2d& pixel, double depth) const {
    return depth * Ray(pixel);
  }
  bool IsInside(const Eigen::Vector2d& pixel, double margin = 0.0) const {
    return pixel.x() >= margin && pixel.y() >= margin && pixel.x() <= width - 1 - margin &&
           pixel.y() <= height - 1 - margin;
  }
  // Mean of |fx| and |fy|: turns an angle (radians) into pixels near the image centre.
  double FocalLength() const { return 0.5 * (std::abs(fx) + std::abs(fy)); }

  bool IsValid(std::string* error) const;
};

// Brown-Conrady lens model in OpenCV's order k1 k2 p1 p2 k3.
struct LensDistortion {
  std::array<double, 5> k = {0.0, 0.0, 0.0, 0.0, 0.0};

  bool IsZero() const { return k == std::array<double, 5>{}; }
  // Distorted pixel of an ideal pixel of `camera`.
  Eigen::Vector2d Distort(const PinholeCamera& camera, const Eigen::Vector2d& pixel) const;
  // The ideal pixel whose Distort() is `pixel`: fixed-point iteration to 1e-9 px, 50 steps at most.
  Eigen::Vector2d Undistort(const PinholeCamera& camera, const Eigen::Vector2d& pixel) const;
};

}  // namespace msc_vo
