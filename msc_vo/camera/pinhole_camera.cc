// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/camera/pinhole_camera.h"

namespace msc_vo {

namespace {

// Applies the lens to a point of the plane z = 1.
Eigen::Vector2d DistortNormalized(const std::array<double, 5>& k, const Eigen::Vector2d& x) {
  const double r2 = x.squaredNorm();
  const double radial = 1.0 + r2 * (k[0] + r2 * (k[1] + r2 * k[4]));
  const double xy2 = 2.0 * x.x() * x.y();
  return {radial * x.x() + k[2] * xy2 + k[3] * (r2 + 2.0 * x.x() * x.x()),
          radial * x.y() + k[3] * xy2 + k[2] * (r2 + 2.0 * x.y() * x.y())};
}

}  // namespace

bool PinholeCamera::IsValid(std::string* error) const {
  if (!(std::isfinite(fx) && std::isfinite(fy) && std::isfinite(cx) && std::isfinite(cy))) {
    *error = "camera: fx, fy, cx and cy must be finite numbers";
  } else if (fx == 0.0 || fy == 0.0) {
    *error = "camera: fx and fy must not be zero";
  } else if (width <= 0 || height <= 0) {
    *error = "camera: width and height must be positive";
  } else {
    return true;
  }
  return false;
}

Eigen::Vector2d LensDistortion::Distort(const PinholeCamera& camera,
                                        const Eigen::Vector2d& pixel) const {
  const Eigen::Vector2d x = DistortNormalized(k, camera.Ray(pixel).head<2>());
  return {camera.fx * x.x() + camera.cx, camera.fy * x.y() + camera.cy};
}

Eigen::Vector2d LensDistortion::Undistort(const PinholeCamera& camera,
                                          const Eigen::Vector2d& pixel) const {
  if (IsZero()) return pixel;
  const Eigen::Vector2d target = camera.Ray(pixel).head<2>();
  const double tolerance = 1e-9 / camera.FocalLength();
  Eigen::Vector2d x = target;
  for (int i = 0; i < 50; ++i) {
    const Eigen::Vector2d step = target - DistortNormalized(k, x);
    x += step;
    if (step.norm() < tolerance) break;
  }
  return {camera.fx * x.x() + camera.cx, camera.fy * x.y() + camera.cy};
}

}  // namespace msc_vo
