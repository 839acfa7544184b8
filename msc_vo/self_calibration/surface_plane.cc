// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/self_calibration/surface_plane.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

#include "msc_vo/sensor/sensor_noise.h"

namespace msc_vo {

namespace {

constexpr int kRadius = 3;
// Of the 49 pixels of the window.
constexpr int kMinPixels = 35;
// Largest r.m.s. of the residuals, in units of the noise of a pixel: chi-square with 46 degrees of
// freedom would allow 1.25 (99 %); the margin covers sensors somewhat worse than their model.
constexpr double kMaxRms = 1.5;
// Steps to the intersection of a viewing ray with the surface of an unregistered depth image.
constexpr int kSteps = 2;

std::optional<InverseDepthPlane> FitPlane(const InverseDepthImage& depth,
                                          const Eigen::Vector2d& pixel) {
  const int center_x = cvRound(pixel.x());
  const int center_y = cvRound(pixel.y());
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
  Eigen::Vector3d rhs = Eigen::Vector3d::Zero();
  double squares = 0.0;
  int count = 0;
  for (int y = -kRadius; y <= kRadius; ++y) {
    for (int x = -kRadius; x <= kRadius; ++x) {
      const double w = depth.At(center_x + x, center_y + y);
      if (w <= 0.0) continue;
      const Eigen::Vector3d basis(1.0, x, y);
      matrix += basis * basis.transpose();
      rhs += w * basis;
      squares += w * w;
      ++count;
    }
  }
  if (count < kMinPixels) return std::nullopt;
  const Eigen::Vector3d plane = matrix.ldlt().solve(rhs);
  const double variance = std::max(0.0, squares - plane.dot(rhs)) / (count - 3);
  const double limit = kMaxRms * SensorNoiseOptions().inverse_depth_noise;
  if (variance > limit * limit) return std::nullopt;
  return InverseDepthPlane{{center_x, center_y}, plane.x(), plane.tail<2>()};
}

}  // namespace

std::optional<InverseDepthPlane> FindSurface(const CorrectedCamera& camera,
                                             const InverseDepthImage& depth,
                                             const Eigen::Vector2d& pixel,
                                             const SensorCorrection::Vector& correction) {
  Eigen::Vector2d at_infinity, parallax;
  camera.DepthPixel(pixel, correction.data(), &at_infinity, &parallax);
  Eigen::Vector2d depth_pixel = at_infinity;
  if (parallax.norm() > 0.0) {
    for (int i = 0; i < kSteps; ++i) {
      depth_pixel = at_infinity + depth.Nearest(depth_pixel) * parallax;
    }
  }
  return FitPlane(depth, depth_pixel);
}

}  // namespace msc_vo
