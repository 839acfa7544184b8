// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/camera/lens_validity.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace msc_vo {

namespace {

constexpr int kDirections = 64;  // per circle; the distortion varies slowly with the direction
constexpr int kCircles = 1000;   // up to the corner of the image: less than a pixel apart
// The lens must be one-to-one slightly beyond the corners, because the coefficients are uncertain.
constexpr double kMargin = 1.02;

// Smaller eigenvalue of a symmetric matrix.
double SmallerEigenvalue(const Eigen::Matrix2d& m) {
  return 0.5 * m.trace() - std::hypot(0.5 * (m(0, 0) - m(1, 1)), m(0, 1));
}

// A distorted circle around the optical axis.
struct DistortedCircle {
  // Smallest eigenvalue of the Jacobian on the circle.
  double smallest_stretch = std::numeric_limits<double>::infinity();
  // Smallest distance of the distorted circle from the optical axis.
  double radius = std::numeric_limits<double>::infinity();
};

DistortedCircle DistortCircle(const LensDistortion& distortion, double radius) {
  DistortedCircle circle;
  for (int i = 0; i < kDirections; ++i) {
    const double angle = 2.0 * M_PI * i / kDirections;
    const Eigen::Vector2d x(radius * std::cos(angle), radius * std::sin(angle));
    const double stretch = SmallerEigenvalue(distortion.Jacobian(x));
    // Overflow (NaN) counts as a fold.
    if (!(stretch >= circle.smallest_stretch)) circle.smallest_stretch = stretch;
    circle.radius = std::min(circle.radius, distortion.DistortNormalized(x).norm());
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
                        double undistorted_radius, double recorded_radius) {
  std::ostringstream text;
  const auto length = [&](double radius) {
    std::ostringstream length_text;
    length_text.precision(3);
    length_text << radius << " (" << std::round(radius * camera.FocalLength()) << " pixels)";
    return length_text.str();
  };
  text << "camera: the lens k1 k2 p1 p2 k3 =";
  for (const double k : distortion.k) text << " " << k;
  text << " folds over at radius " << length(undistorted_radius)
       << " of the undistorted image, which is " << length(recorded_radius)
       << " of the recorded one, whose corners are at " << length(CornerRadius(camera))
       << "; check the values and their order k1 k2 p1 p2 k3";
  return text.str();
}

}  // namespace

bool IsInvertible(const LensDistortion& distortion, const PinholeCamera& camera,
                  std::string* error) {
  for (const double k : distortion.k) {
    if (std::isfinite(k)) continue;
    *error = "camera: the distortion coefficients k1 k2 p1 p2 k3 must be finite numbers";
    return false;
  }
  if (distortion.IsZero()) return true;
  const double corner_radius = CornerRadius(camera);
  const double needed = kMargin * corner_radius;
  // The loop ends: without a fold, the distorted radius grows at least as fast as a fixed fraction
  // of the radius.
  double recorded_radius = 0.0;
  for (int i = 1;; ++i) {
    const double radius = i * corner_radius / kCircles;
    const DistortedCircle circle = DistortCircle(distortion, radius);
    if (!(circle.smallest_stretch > 0.0)) {
      *error = FoldMessage(distortion, camera, radius, recorded_radius);
      return false;
    }
    recorded_radius = circle.radius;
    if (radius >= needed && recorded_radius >= needed) return true;
  }
}

}  // namespace msc_vo
