// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/features/surface_normals.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <Eigen/Geometry>

#include "msc_vo/camera/lens_validity.h"
#include "msc_vo/geometry/angles.h"

namespace msc_vo {

namespace {

using Eigen::Vector3d;

// Metres: below the resolution of every depth sensor, and coarse enough that a window's sum fits
// into 32 bits.
constexpr double kUnit = 1e-4;
constexpr uint32_t kDepthPixel = 1;
constexpr uint32_t kDepthEdge = 1u << 16;
// A step of depth between neighbours is an edge beyond so many sigmas of a difference: 99.7 %.
constexpr double kEdgeSigmas = 3.0;

int Count(uint32_t pixels_and_edges) { return static_cast<int>(pixels_and_edges & 0xffff); }
int Edges(uint32_t pixels_and_edges) { return static_cast<int>(pixels_and_edges >> 16); }

Vector3d MeanPoint(const std::array<uint32_t, 4>& sums) {
  const double scale = kUnit / Count(sums[3]);
  return scale * Vector3d(static_cast<int32_t>(sums[0]), static_cast<int32_t>(sums[1]),
                          static_cast<int32_t>(sums[2]));
}

uint32_t InUnits(float metres) {
  return static_cast<uint32_t>(cvRound(metres * static_cast<float>(1.0 / kUnit)));
}

}  // namespace

// A square of pixels around (x, y), clipped by the image.
struct SurfaceNormalEstimator::Window {
  int x = 0;
  int y = 0;
  int radius = 0;
  int left = 0;  // first and last pixels
  int top = 0;
  int right = 0;
  int bottom = 0;
};

bool SurfaceNormalOptions::IsValid(std::string* error) const {
  if (grid_step < 1) {
    *error = "grid_step must be at least 1 pixel";
  } else if (!(target_sigma > 0.0)) {
    *error = "target_sigma must be positive (radians)";
  } else if (!(inverse_depth_sigma > 0.0)) {
    *error = "inverse_depth_sigma must be positive (1/metres)";
  } else if (!(correlation >= 1.0)) {
    *error = "correlation must be at least 1 pixel";
  } else if (!(min_radius >= 1 && max_radius >= min_radius)) {
    *error = "1 <= min_radius <= max_radius (pixels) must hold";
  } else if (!(max_incidence > 0.0 && max_incidence < 0.5 * kPi)) {
    *error = "max_incidence must lie in (0, pi/2) (radians)";
  } else if (!(min_valid > 0.0 && min_valid <= 1.0)) {
    *error = "min_valid must lie in (0, 1]";
  } else if (!(min_depth > 0.0 && max_depth > min_depth)) {
    *error = "0 < min_depth < max_depth (metres) must hold";
  } else if (std::pow(2.0 * max_radius + 1.0, 2) * max_depth / kUnit > std::pow(2.0, 30)) {
    // A factor of 2 is left for rays that go farther sideways than forward.
    *error = "(2 max_radius + 1)^2 max_depth is too large for 32-bit sums: at most 107374 px^2 m";
  } else {
    return true;
  }
  return false;
}

SurfaceNormalEstimator::SurfaceNormalEstimator(const SurfaceNormalOptions& options,
                                               const PinholeCamera& camera,
                                               const LensDistortion& distortion)
    : options_(options), camera_(camera) {
  std::string error;
  if (!options.IsValid(&error) || !camera.IsValid(&error) ||
      !IsInvertible(distortion, camera, &error)) {
    throw std::invalid_argument("SurfaceNormalEstimator: " + error);
  }
  rays_.reserve(static_cast<size_t>(camera.width) * camera.height);
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      Eigen::Vector2d pixel(x, y);
      if (!distortion.IsZero()) pixel = distortion.Undistort(camera, pixel);
      const Vector3d ray = camera.Ray(pixel);
      rays_.push_back({static_cast<float>(ray.x()), static_cast<float>(ray.y())});
    }
  }
  integral_.resize(static_cast<size_t>(camera.width + 1) * (camera.height + 1));
}

void SurfaceNormalEstimator::Integrate(const cv::Mat& depth) {
  const int width = camera_.width;
  const auto nearest = static_cast<float>(options_.min_depth);
  const auto farthest = static_cast<float>(options_.max_depth);
  // Relative change of depth from one pixel to the next on the steepest surface; and noise, whose
  // sigma relative to z is z sigma_w, of two pixels.
  const auto steepest =
      static_cast<float>(std::tan(options_.max_incidence) / camera_.FocalLength());
  const auto noise =
      static_cast<float>(kEdgeSigmas * std::sqrt(2.0) * options_.inverse_depth_sigma);
  const auto is_edge = [&](float z, float neighbour) {
    return neighbour >= nearest && neighbour <= farthest &&
           std::abs(z - neighbour) > z * (steepest + noise * z);
  };
  for (int y = 0; y < camera_.height; ++y) {
    const float* z_row = depth.ptr<float>(y);
    const float* z_above = depth.ptr<float>(std::max(y - 1, 0));
    const std::array<float, 2>* ray = &rays_[static_cast<size_t>(y) * width];
    const Sums* above = &integral_[static_cast<size_t>(y) * (width + 1)];
    Sums* here = &integral_[static_cast<size_t>(y + 1) * (width + 1)];
    Sums row{};
    for (int x = 0; x < width; ++x) {
      const float z = z_row[x];
      if (z >= nearest && z <= farthest) {  // false for what is not a number
        row[0] += InUnits(z * ray[x][0]);
        row[1] += InUnits(z * ray[x][1]);
        row[2] += InUnits(z);
        row[3] += kDepthPixel;
        if (is_edge(z, z_row[std::max(x - 1, 0)]) || is_edge(z, z_above[x])) row[3] += kDepthEdge;
      }
      for (int i = 0; i < 4; ++i) here[x + 1][i] = above[x + 1][i] + row[i];
    }
  }
}

SurfaceNormalEstimator::Sums SurfaceNormalEstimator::SumOver(int left, int top, int right,
                                                             int bottom) const {
  const size_t stride = camera_.width + 1;
  const Sums& a = integral_[top * stride + left];
  const Sums& b = integral_[top * stride + right + 1];
  const Sums& c = integral_[(bottom + 1) * stride + left];
  const Sums& d = integral_[(bottom + 1) * stride + right + 1];
  Sums sums;
  for (int i = 0; i < 4; ++i) sums[i] = d[i] - b[i] - c[i] + a[i];
  return sums;
}

// Of a normal at depth z from a window of that radius. The mean points of two halves lie radius
// pixels, radius z / f metres, apart; each has noise z^2 sigma_w / sqrt(n) along the ray, with n =
// 2 radius^2 / correlation^2 independent pixels. The quotient is the angle.
double SurfaceNormalEstimator::Sigma(double z, double radius) const {
  return z * camera_.FocalLength() * options_.inverse_depth_sigma * options_.correlation /
         (radius * radius);
}

// The largest window, from what depth z asks for downwards, without a depth edge.
bool SurfaceNormalEstimator::FitWindow(int x, int y, double z, Window* window) const {
  const double wanted = std::sqrt(Sigma(z, 1.0) / options_.target_sigma);
  int radius = static_cast<int>(
      std::clamp<double>(std::ceil(wanted), options_.min_radius, options_.max_radius));
  for (; radius >= options_.min_radius; radius = radius * 3 / 4) {
    *window = {x,
               y,
               radius,
               std::max(x - radius, 0),
               std::max(y - radius, 0),
               std::min(x + radius, camera_.width - 1),
               std::min(y + radius, camera_.height - 1)};
    const uint32_t sums = SumOver(window->left, window->top, window->right, window->bottom)[3];
    if (Edges(sums) == 0) {
      const int area = (window->right - window->left + 1) * (window->bottom - window->top + 1);
      return Count(sums) >= options_.min_valid * area;
    }
  }
  return false;
}

bool SurfaceNormalEstimator::NormalAt(const Window& window, SurfaceNormal* normal) const {
  const Sums left = SumOver(window.left, window.top, window.x - 1, window.bottom);
  const Sums right = SumOver(window.x + 1, window.top, window.right, window.bottom);
  const Sums upper = SumOver(window.left, window.top, window.right, window.y - 1);
  const Sums lower = SumOver(window.left, window.y + 1, window.right, window.bottom);
  for (const Sums& half : {left, right, upper, lower}) {
    if (Count(half[3]) == 0) return false;
  }
  const Vector3d horizontal = MeanPoint(right) - MeanPoint(left);
  const Vector3d vertical = MeanPoint(lower) - MeanPoint(upper);
  const Vector3d cross = horizontal.cross(vertical);
  if (cross.norm() < 1e-12) return false;  // less than a kUnit long
  normal->position = MeanPoint(SumOver(window.left, window.top, window.right, window.bottom));
  normal->direction = cross.normalized();
  if (normal->direction.dot(normal->position) > 0.0) normal->direction = -normal->direction;
  const double cosine = -normal->direction.dot(normal->position.normalized());
  if (cosine < std::cos(options_.max_incidence)) return false;
  normal->sigma = Sigma(normal->position.z(), window.radius);
  return true;
}

std::vector<SurfaceNormal> SurfaceNormalEstimator::Estimate(const cv::Mat& depth) {
  if (depth.type() != CV_32FC1 || depth.cols != camera_.width || depth.rows != camera_.height) {
    throw std::invalid_argument(
        "SurfaceNormalEstimator: the depth image must be float (CV_32FC1, metres) of " +
        std::to_string(camera_.width) + "x" + std::to_string(camera_.height) +
        " pixels, as the camera says; it is " + std::to_string(depth.cols) + "x" +
        std::to_string(depth.rows) + ", OpenCV type " + std::to_string(depth.type()));
  }
  Integrate(depth);
  std::vector<SurfaceNormal> normals;
  const int step = options_.grid_step;
  for (int y = step / 2; y < camera_.height; y += step) {
    for (int x = step / 2; x < camera_.width; x += step) {
      const double z = depth.at<float>(y, x);
      Window window;
      SurfaceNormal normal;
      if (!(z >= options_.min_depth && z <= options_.max_depth)) continue;
      if (FitWindow(x, y, z, &window) && NormalAt(window, &normal)) normals.push_back(normal);
    }
  }
  return normals;
}

}  // namespace msc_vo
