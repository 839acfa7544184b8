// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/camera/lens_validity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <locale>
#include <sstream>

namespace msc_vo {

namespace {

constexpr int kDirections = 64;  // per circle; the distortion varies slowly with the direction
constexpr int kCircles = 1000;   // up to the corner of the image: less than a pixel apart
// A rational lens may approach a largest recorded radius without a fold: 50 image corners away, a
// recorded pixel has no undistorted one of any use.
constexpr int kMaxCircles = 50 * kCircles;
// The lens must be one-to-one slightly beyond the corners, because the coefficients are uncertain.
constexpr double kMargin = 1.02;

using Directions = std::array<Eigen::Vector2d, kDirections>;

Directions UnitCircle() {
  Directions directions;
  for (int i = 0; i < kDirections; ++i) {
    const double angle = 2.0 * M_PI * i / kDirections;
    directions[i] = {std::cos(angle), std::sin(angle)};
  }
  return directions;
}

// Smaller eigenvalue of a symmetric matrix.
double SmallerEigenvalue(const Eigen::Matrix2d& m) {
  const double half_difference = 0.5 * (m(0, 0) - m(1, 1));
  return 0.5 * m.trace() - std::sqrt(half_difference * half_difference + m(0, 1) * m(0, 1));
}

// A distorted circle around the optical axis.
struct DistortedCircle {
  // Smallest eigenvalue of the Jacobian on the circle.
  double smallest_stretch = std::numeric_limits<double>::infinity();
  // Smallest distance of the distorted circle from the optical axis.
  double radius = std::numeric_limits<double>::infinity();
};

DistortedCircle DistortCircle(const LensDistortion& distortion, double radius) {
  static const Directions directions = UnitCircle();
  DistortedCircle circle;
  for (const Eigen::Vector2d& direction : directions) {
    const Eigen::Vector2d x = radius * direction;
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
  text.imbue(std::locale::classic());
  const PinholeCamera& recorded = distortion.Recorded(camera);
  const auto length = [](double radius, const PinholeCamera& in) {
    std::ostringstream length_text;
    length_text.imbue(std::locale::classic());
    length_text.precision(3);
    length_text << radius << " (" << std::round(radius * in.FocalLength()) << " pixels)";
    return length_text.str();
  };
  const std::string names = LensCoefficientList(distortion.model);
  text << "camera: the lens " << names << " =";
  for (const double k : distortion.Coefficients()) text << " " << k;
  text << " folds over at radius " << length(undistorted_radius, camera)
       << " of the undistorted image, which is " << length(recorded_radius, recorded)
       << " of the recorded one, whose corners are at " << length(CornerRadius(recorded), recorded)
       << "; check the values and their order " << names;
  if (distortion.IsCropped()) {
    text << ", or give a smaller field_of_view: the corners of the undistorted image are at "
         << length(CornerRadius(camera), camera);
  }
  return text.str();
}

// Largest radius that a circle around the optical axis must have, and its distortion.
struct NeededRadius {
  double undistorted = 0.0;
  double recorded = 0.0;
};

NeededRadius Needed(const LensDistortion& distortion, const PinholeCamera& camera) {
  const double undistorted = kMargin * CornerRadius(camera);
  // Recorded pixels that a cropped image does not show need no undistorted one.
  return {undistorted, distortion.IsCropped() ? 0.0 : undistorted};
}

}  // namespace

bool IsInvertible(const LensDistortion& distortion, const PinholeCamera& camera,
                  std::string* error) {
  for (const double k : distortion.k) {
    if (std::isfinite(k)) continue;
    *error = "camera: the distortion coefficients " + LensCoefficientList(distortion.model) +
             " must be finite numbers";
    return false;
  }
  if (distortion.IsZero()) return true;
  const double corner_radius = CornerRadius(camera);
  const NeededRadius needed = Needed(distortion, camera);
  // The loop ends: the distorted radius of a polynomial without a fold grows at least as fast as a
  // fixed fraction of the radius, and the last circle lies far outside any image.
  double recorded_radius = 0.0;
  for (int i = 1; i <= kMaxCircles; ++i) {
    const double radius = i * corner_radius / kCircles;
    const DistortedCircle circle = DistortCircle(distortion, radius);
    if (!(circle.smallest_stretch > 0.0)) {
      *error = FoldMessage(distortion, camera, radius, recorded_radius);
      return false;
    }
    recorded_radius = circle.radius;
    if (radius >= needed.undistorted && recorded_radius >= needed.recorded) return true;
  }
  *error = "camera: the lens " + LensCoefficientList(distortion.model) +
           " maps everything that it sees into a part of the recorded image; check the values and "
           "their order";
  return false;
}

}  // namespace msc_vo
