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

// The pixels around the one that is nearest to a point, `step` pixels of the full image apart.
template <typename Depth>
struct Neighbors;

// In a full image, pixels between two of them are left out if it is wider than 640.
template <>
struct Neighbors<InverseDepthImage> {
  Neighbors(const InverseDepthImage& image, int width, const Eigen::Vector2d& point)
      : depth(image), step(ReducingStep(width)), x(cvRound(point.x())), y(cvRound(point.y())) {}
  Eigen::Vector2d Center() const { return Eigen::Vector2d(x, y); }
  double At(int i, int j) const { return depth.At(x + step * i, y + step * j); }

  const InverseDepthImage& depth;
  int step, x, y;
};

// In an image that is kept for self-calibration, all of its pixels.
template <>
struct Neighbors<RecordedImage> {
  Neighbors(const RecordedImage& image, int /*width*/, const Eigen::Vector2d& point)
      : depth(image),
        step(image.step()),
        column(cvRound(point.x() / step)),
        row(cvRound(point.y() / step)) {}
  Eigen::Vector2d Center() const { return step * Eigen::Vector2d(column, row); }
  double At(int i, int j) const { return depth.At(column + i, row + j); }

  const RecordedImage& depth;
  int step, column, row;
};

template <typename Depth>
std::optional<InverseDepthPlane> FitPlane(const Neighbors<Depth>& neighbors, int width) {
  const int radius = ScaledLength(kRadius / neighbors.step, width, 2);
  double squares = 0.0, sum_w = 0.0, sum_xw = 0.0, sum_yw = 0.0;
  int count = 0, sum_x = 0, sum_y = 0, sum_xx = 0, sum_xy = 0, sum_yy = 0;
  for (int y = -radius; y <= radius; ++y) {
    for (int x = -radius; x <= radius; ++x) {
      const double w = neighbors.At(x, y);
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
  return InverseDepthPlane{neighbors.Center(), plane.x(), plane.tail<2>() / neighbors.step};
}

}  // namespace

template <typename Depth>
std::optional<InverseDepthPlane> FindSurface(const LinearizedCamera& camera, const Depth& depth,
                                             const Eigen::Vector2d& pixel) {
  const int width = camera.given().width;
  const Eigen::Vector2d at_infinity = camera.DepthPixelAtInfinity(pixel);
  Eigen::Vector2d depth_pixel = at_infinity;
  if (camera.parallax().norm() > 0.0) {
    for (int i = 0; i < kSteps; ++i) {
      const double w = Neighbors<Depth>(depth, width, depth_pixel).At(0, 0);
      depth_pixel = at_infinity + w * camera.parallax();
    }
  }
  return FitPlane(Neighbors<Depth>(depth, width, depth_pixel), width);
}

template std::optional<InverseDepthPlane> FindSurface(const LinearizedCamera&,
                                                      const InverseDepthImage&,
                                                      const Eigen::Vector2d&);
template std::optional<InverseDepthPlane> FindSurface(const LinearizedCamera&, const RecordedImage&,
                                                      const Eigen::Vector2d&);

}  // namespace msc_vo
