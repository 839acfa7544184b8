// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/camera/lens_distortion.h"

#include <Eigen/LU>

namespace msc_vo {

namespace {

constexpr int kMaxSteps = 100;
// A fixed-point step that leaves a larger fraction of the residual is replaced by a Newton step.
constexpr double kMaxResidualRatio = 0.75;

}  // namespace

Eigen::Vector2d LensDistortion::DistortNormalized(const Eigen::Vector2d& x) const {
  const double r2 = x.squaredNorm();
  const double radial = 1.0 + r2 * (k[0] + r2 * (k[1] + r2 * k[4]));
  const double xy2 = 2.0 * x.x() * x.y();
  return {radial * x.x() + k[2] * xy2 + k[3] * (r2 + 2.0 * x.x() * x.x()),
          radial * x.y() + k[3] * xy2 + k[2] * (r2 + 2.0 * x.y() * x.y())};
}

Eigen::Matrix2d LensDistortion::Jacobian(const Eigen::Vector2d& x) const {
  const double r2 = x.squaredNorm();
  const double radial = 1.0 + r2 * (k[0] + r2 * (k[1] + r2 * k[4]));
  // Derivative of `radial` with respect to r2 / 2.
  const double slope = 2.0 * (k[0] + r2 * (2.0 * k[1] + r2 * 3.0 * k[4]));
  const double xy = slope * x.x() * x.y() + 2.0 * (k[2] * x.x() + k[3] * x.y());
  Eigen::Matrix2d jacobian;
  jacobian << radial + slope * x.x() * x.x() + 2.0 * k[2] * x.y() + 6.0 * k[3] * x.x(), xy,  //
      xy, radial + slope * x.y() * x.y() + 6.0 * k[2] * x.y() + 2.0 * k[3] * x.x();
  return jacobian;
}

Eigen::Vector2d LensDistortion::Distort(const PinholeCamera& camera,
                                        const Eigen::Vector2d& pixel) const {
  const Eigen::Vector2d x = DistortNormalized(camera.Ray(pixel).head<2>());
  return {camera.fx * x.x() + camera.cx, camera.fy * x.y() + camera.cy};
}

Eigen::Vector2d LensDistortion::Undistort(const PinholeCamera& camera,
                                          const Eigen::Vector2d& pixel) const {
  if (IsZero()) return pixel;
  const Eigen::Vector2d target = camera.Ray(pixel).head<2>();
  const double tolerance = 1e-9 / camera.FocalLength();
  Eigen::Vector2d x = target;
  Eigen::Vector2d residual = target - DistortNormalized(x);
  for (int i = 0; i < kMaxSteps && !(residual.norm() < tolerance); ++i) {
    // The fixed-point step suffices for nearly every lens; strong distortion needs Newton's.
    Eigen::Vector2d step = residual;
    Eigen::Vector2d next = target - DistortNormalized(x + step);
    if (!(next.norm() < kMaxResidualRatio * residual.norm())) {
      step = Jacobian(x).inverse() * residual;
      next = target - DistortNormalized(x + step);
    }
    while (!(next.norm() < residual.norm()) && step.norm() > tolerance) {
      step *= 0.5;
      next = target - DistortNormalized(x + step);
    }
    if (!(next.norm() < residual.norm())) break;
    x += step;
    residual = next;
  }
  x += residual;
  return {camera.fx * x.x() + camera.cx, camera.fy * x.y() + camera.cy};
}

}  // namespace msc_vo
