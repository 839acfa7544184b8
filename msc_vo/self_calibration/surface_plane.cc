// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/self_calibration/surface_plane.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include "msc_vo/camera/image_scale.h"
#include "msc_vo/sensor/sensor_noise.h"

namespace msc_vo {

namespace {

// Radius of the window at an image width of 640 pixels.
constexpr double kRadius = 3.0;
// Part of the pixels of the window that must have a depth: 35 of 49.
constexpr double kMinPixels = 0.71;
// Largest r.m.s. of the residuals, in units of the noise of a pixel: chi-square with 46 degrees of
// freedom would allow 1.25 (99 %), with 22, in small images, 1.35; the margin covers sensors
// somewhat worse than their model.
constexpr double kMaxRms = 1.5;
// Steps to the intersection of a viewing ray with the surface of an unregistered depth image.
constexpr int kSteps = 2;

template <typename Depth>
std::optional<InverseDepthPlane> FitPlane(const Depth& depth, int width,
                                          const Eigen::Vector2d& pixel) {
  // A wider image has the same number of pixels in its window, at a larger distance.
  const int step = ReducingStep(width);
  const int radius = ScaledLength(kRadius / step, width, 2);
  const int center_x = cvRound(pixel.x());
  const int center_y = cvRound(pixel.y());
  double squares = 0.0, sum_w = 0.0, sum_xw = 0.0, sum_yw = 0.0;
  int count = 0, sum_x = 0, sum_y = 0, sum_xx = 0, sum_xy = 0, sum_yy = 0;
  for (int y = -radius; y <= radius; ++y) {
    for (int x = -radius; x <= radius; ++x) {
      const double w = depth.At(center_x + step * x, center_y + step * y);
      if (w <= 0.0) continue;
      sum_x += x;
      sum_y += y;
      sum_xx += x * x;
      sum_xy += x * y;
      sum_yy += y * y;
      sum_w += w;
      sum_xw += x * w;
      sum_yw += y * w;
      squares += w * w;
      ++count;
    }
  }
  if (count < kMinPixels * (2 * radius + 1) * (2 * radius + 1)) return std::nullopt;
  Eigen::Matrix3d matrix;
  matrix << count, sum_x, sum_y, sum_x, sum_xx, sum_xy, sum_y, sum_xy, sum_yy;
  const Eigen::Vector3d rhs(sum_w, sum_xw, sum_yw);
  const Eigen::Vector3d plane = matrix.inverse() * rhs;
  const double variance = std::max(0.0, squares - plane.dot(rhs)) / (count - 3);
  const double limit = kMaxRms * SensorNoiseOptions().inverse_depth_noise;
  if (variance > limit * limit) return std::nullopt;
  return InverseDepthPlane{{center_x, center_y}, plane.x(), plane.tail<2>() / step};
}

}  // namespace

template <typename Depth>
std::optional<InverseDepthPlane> FindSurface(const LinearizedCamera& camera, const Depth& depth,
                                             const Eigen::Vector2d& pixel) {
  const Eigen::Vector2d at_infinity = camera.DepthPixelAtInfinity(pixel);
  Eigen::Vector2d depth_pixel = at_infinity;
  if (camera.parallax().norm() > 0.0) {
    for (int i = 0; i < kSteps; ++i) {
      const double w = depth.At(cvRound(depth_pixel.x()), cvRound(depth_pixel.y()));
      depth_pixel = at_infinity + w * camera.parallax();
    }
  }
  return FitPlane(depth, camera.given().width, depth_pixel);
}

template std::optional<InverseDepthPlane> FindSurface(const LinearizedCamera&,
                                                      const InverseDepthImage&,
                                                      const Eigen::Vector2d&);
template std::optional<InverseDepthPlane> FindSurface(const LinearizedCamera&, const RecordedImage&,
                                                      const Eigen::Vector2d&);

}  // namespace msc_vo
