// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/camera/lens_validity.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace msc_vo {

namespace {

constexpr int kDirections = 64;
constexpr int kCircles = 1000;  // up to the corner of the image: finer than a pixel
// The lens must be one to one a little beyond the corners: coefficients are known to so much.
constexpr double kMargin = 1.02;

// The plane z = 1 as an image.
const PinholeCamera& NormalizedCamera() {
  static const PinholeCamera camera{1.0, 1.0, 0.0, 0.0, 1, 1};
  return camera;
}

// Smaller eigenvalue of a symmetric matrix.
double SmallerEigenvalue(const Eigen::Matrix2d& m) {
  return 0.5 * m.trace() - std::hypot(0.5 * (m(0, 0) - m(1, 1)), m(0, 1));
}

// What the distortion does to a circle around the optical axis.
struct Circle {
  double smallest_stretch = std::numeric_limits<double>::infinity();
  double distorted_radius = std::numeric_limits<double>::infinity();  // smallest distance
};

Circle DistortCircle(const LensDistortion& distortion, double radius) {
  Circle circle;
  for (int i = 0; i < kDirections; ++i) {
    const double angle = 2.0 * M_PI * i / kDirections;
    const Eigen::Vector2d x(radius * std::cos(angle), radius * std::sin(angle));
    const double stretch = SmallerEigenvalue(DistortionJacobian(distortion, x));
    // An overflow is no number and counts as a fold.
    if (!(stretch >= circle.smallest_stretch)) circle.smallest_stretch = stretch;
    circle.distorted_radius =
        std::min(circle.distorted_radius, distortion.Distort(NormalizedCamera(), x).norm());
  }
  return circle;
}

// Distance of the farthest corner of the image from the optical axis on the plane z = 1.
double CornerRadius(const PinholeCamera& camera) {
  double radius = 0.0;
  for (const double x : {0.0, camera.width - 1.0}) {
    for (const double y : {0.0, camera.height - 1.0}) {
      radius = std::max(radius, camera.Ray({x, y}).head<2>().norm());
    }
  }
  return radius;
}

std::string FoldMessage(const LensDistortion& distortion, const PinholeCamera& camera,
                        double ideal_radius, double recorded_radius) {
  std::ostringstream text;
  const auto length = [&](double radius) {
    std::ostringstream one;
    one.precision(3);
    one << radius << " (" << std::round(radius * camera.FocalLength()) << " pixels)";
    return one.str();
  };
  text << "camera: the lens k1 k2 p1 p2 k3 =";
  for (const double k : distortion.k) text << " " << k;
  text << " folds over at radius " << length(ideal_radius) << " of the undistorted image, which is "
       << length(recorded_radius) << " of the recorded one, whose corners are at "
       << length(CornerRadius(camera))
       << "; check the values, and that they come in the order k1 k2 p1 p2 k3";
  return text.str();
}

}  // namespace

Eigen::Matrix2d DistortionJacobian(const LensDistortion& distortion, const Eigen::Vector2d& x) {
  const std::array<double, 5>& k = distortion.k;
  const double r2 = x.squaredNorm();
  const double radial = 1.0 + r2 * (k[0] + r2 * (k[1] + r2 * k[4]));
  const double slope = 2.0 * (k[0] + r2 * (2.0 * k[1] + r2 * 3.0 * k[4]));  // of radial, by r2 / 2
  const double xy = slope * x.x() * x.y() + 2.0 * (k[2] * x.x() + k[3] * x.y());
  Eigen::Matrix2d jacobian;
  jacobian << radial + slope * x.x() * x.x() + 2.0 * k[2] * x.y() + 6.0 * k[3] * x.x(), xy,  //
      xy, radial + slope * x.y() * x.y() + 6.0 * k[2] * x.y() + 2.0 * k[3] * x.x();
  return jacobian;
}

bool IsInvertible(const LensDistortion& distortion, const PinholeCamera& camera,
                  std::string* error) {
  for (const double k : distortion.k) {
    if (std::isfinite(k)) continue;
    *error = "camera: the distortion coefficients k1 k2 p1 p2 k3 must be finite numbers";
    return false;
  }
  if (distortion.IsZero()) return true;
  const double corner = CornerRadius(camera);
  const double needed = kMargin * corner;
  // Ends: without a fold, the distorted radius grows at least as fast as a fixed part of the
  // radius.
  double recorded = 0.0;
  for (int i = 1;; ++i) {
    const double radius = i * corner / kCircles;
    const Circle circle = DistortCircle(distortion, radius);
    if (!(circle.smallest_stretch > 0.0)) {
      *error = FoldMessage(distortion, camera, radius, recorded);
      return false;
    }
    recorded = circle.distorted_radius;
    if (radius >= needed && recorded >= needed) return true;
  }
}

}  // namespace msc_vo
