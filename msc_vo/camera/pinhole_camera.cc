// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/camera/pinhole_camera.h"

#include <algorithm>
#include <sstream>

#include <Eigen/LU>

#include "msc_vo/camera/lens_validity.h"

namespace msc_vo {

namespace {

constexpr int kMaxSide = 16384;  // pixels of an image
// Of the longer side of the image: 175 and 0.3 degrees of it are seen.
constexpr double kMinFocalLength = 0.02;
constexpr double kMaxFocalLength = 200.0;
// Between the two focal lengths: pixels are nearly square.
constexpr double kMaxAspect = 2.0;

// Of the undistortion: at most so many steps, and what a step must leave of the residual.
constexpr int kMaxSteps = 100;
constexpr double kGoodStep = 0.75;

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
  const int longer_side = std::max(width, height);
  const double shortest = kMinFocalLength * longer_side;
  const double longest = kMaxFocalLength * longer_side;
  const auto is_within = [error](const char* name, double value, double from, double to) {
    if (value >= from && value <= to) return true;  // false for what is not a number
    std::ostringstream text;
    text << "camera: " << name << " = " << value << " must be from " << from << " to " << to
         << " pixels";
    *error = text.str();
    return false;
  };
  return is_within("width", width, 1, kMaxSide) && is_within("height", height, 1, kMaxSide) &&
         is_within("fx", fx, shortest, longest) &&
         is_within(fy < 0.0 ? "-fy" : "fy", std::abs(fy), fx / kMaxAspect, fx * kMaxAspect) &&
         is_within("cx", cx, 0.0, width) && is_within("cy", cy, 0.0, height);
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
  Eigen::Vector2d residual = target - DistortNormalized(k, x);
  for (int i = 0; i < kMaxSteps && !(residual.norm() < tolerance); ++i) {
    // The fixed point's step, which nearly every lens leaves; Newton's where the lens is strong.
    Eigen::Vector2d step = residual;
    Eigen::Vector2d next = target - DistortNormalized(k, x + step);
    if (!(next.norm() < kGoodStep * residual.norm())) {
      step = DistortionJacobian(*this, x).inverse() * residual;
      next = target - DistortNormalized(k, x + step);
    }
    while (!(next.norm() < residual.norm()) && step.norm() > tolerance) {
      step *= 0.5;
      next = target - DistortNormalized(k, x + step);
    }
    if (!(next.norm() < residual.norm())) break;
    x += step;
    residual = next;
  }
  x += residual;
  return {camera.fx * x.x() + camera.cx, camera.fy * x.y() + camera.cy};
}

}  // namespace msc_vo
