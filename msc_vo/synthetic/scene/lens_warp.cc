// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/synthetic/scene/lens_warp.h"

#include <algorithm>
#include <cmath>

namespace msc_vo {

namespace {

using Eigen::Vector2d;
using Eigen::Vector2f;

constexpr int kSamples = 4;
constexpr double kOffsets[kSamples][2] = {
    {-0.25, -0.25}, {0.25, -0.25}, {-0.25, 0.25}, {0.25, 0.25}};
// Border of the source image around what the lens sees, pixels: for bilinear interpolation.
constexpr double kBorder = 2.0;
// Four neighbours lie on one plane if their inverse depths differ by less than this ratio, and
// their second difference is rounding.
constexpr float kMaxStep = 0.04f;
constexpr float kMaxBend = 4e-6f;
const Vector2f kBlack(-1.0f, -1.0f);

double MaxRadius() { return std::tan(LensWarp::kMaxAngle * M_PI / 180.0); }

// Larger eigenvalue of a symmetric matrix.
double LargerEigenvalue(const Eigen::Matrix2d& m) {
  return 0.5 * m.trace() + std::hypot(0.5 * (m(0, 0) - m(1, 1)), m(0, 1));
}

// The point of the plane z = 1 that a recorded pixel shows.
Vector2d RayOf(const PinholeCamera& recorded, const LensDistortion& lens, const Vector2d& pixel) {
  return recorded.Ray(lens.Undistort(recorded, pixel)).head<2>();
}

PinholeCamera SourceCamera(const PinholeCamera& recorded, const LensDistortion& lens) {
  double stretch = 1.0;
  Vector2d low = Vector2d::Zero(), high = Vector2d::Zero();
  for (int y = 0; y < recorded.height; ++y) {
    for (int x = 0; x < recorded.width; ++x) {
      const Vector2d ray = RayOf(recorded, lens, {x, y});
      if (ray.norm() > MaxRadius()) continue;
      low = low.cwiseMin(ray);
      high = high.cwiseMax(ray);
      stretch = std::max(stretch, LargerEigenvalue(lens.Jacobian(ray)));
    }
  }
  PinholeCamera source;
  source.fx = recorded.fx * stretch;
  source.fy = recorded.fy * stretch;
  source.cx = std::ceil(kBorder - source.fx * low.x());
  source.cy = std::ceil(kBorder - source.fy * low.y());
  source.width = static_cast<int>(std::ceil(source.cx + source.fx * high.x() + kBorder));
  source.height = static_cast<int>(std::ceil(source.cy + source.fy * high.y() + kBorder));
  return source;
}

// The pixels around a position, and its place between them.
struct Corner {
  size_t first;
  float u, v;

  Corner(const Vector2f& at, int width)
      : first(static_cast<size_t>(at.y()) * width + static_cast<size_t>(at.x())),
        u(at.x() - std::floor(at.x())),
        v(at.y() - std::floor(at.y())) {}

  float Mix(float a, float b, float c, float d) const {
    return (1.0f - v) * ((1.0f - u) * a + u * b) + v * ((1.0f - u) * c + u * d);
  }
};

// Depth at a position: on a plane, inverse depth is affine in the image.
float DepthAt(const RenderedImage& image, const Vector2f& at) {
  const Corner corner(at, image.width);
  const float* const above = &image.depth[corner.first];
  const float* const below = above + image.width;
  const float nearest = (corner.v < 0.5f ? above : below)[corner.u < 0.5f ? 0 : 1];
  if (above[0] <= 0.0f || above[1] <= 0.0f || below[0] <= 0.0f || below[1] <= 0.0f) return nearest;
  const float a = 1.0f / above[0], b = 1.0f / above[1], c = 1.0f / below[0], d = 1.0f / below[1];
  const float largest = std::max(std::max(a, b), std::max(c, d));
  const float smallest = std::min(std::min(a, b), std::min(c, d));
  const bool is_plane =
      largest - smallest < kMaxStep * largest && std::abs((a - b) - (c - d)) < kMaxBend * largest;
  return is_plane ? 1.0f / corner.Mix(a, b, c, d) : nearest;
}

// Adds the colour at a position.
void AddColor(const RenderedImage& image, const Vector2f& at, float* sums) {
  const Corner corner(at, image.width);
  const uint8_t* const above = &image.rgb[3 * corner.first];
  const uint8_t* const below = above + 3 * static_cast<size_t>(image.width);
  for (int k = 0; k < 3; ++k) {
    sums[k] += corner.Mix(above[k], above[k + 3], below[k], below[k + 3]);
  }
}

}  // namespace

LensWarp::LensWarp(const PinholeCamera& recorded, const LensDistortion& lens)
    : width_(recorded.width), height_(recorded.height), source_(SourceCamera(recorded, lens)) {
  const auto source_pixel = [&](double x, double y) -> Vector2f {
    const Vector2d ray = RayOf(recorded, lens, {x, y});
    if (ray.norm() > MaxRadius()) return kBlack;
    const Vector2d pixel = source_.Project({ray.x(), ray.y(), 1.0});
    return source_.IsInside(pixel, 1.0) ? Vector2f(pixel.cast<float>()) : kBlack;
  };
  for (int y = 0; y < height_; ++y) {
    for (int x = 0; x < width_; ++x) {
      centers_.push_back(source_pixel(x, y));
      for (const auto& offset : kOffsets) {
        samples_.push_back(source_pixel(x + offset[0], y + offset[1]));
      }
    }
  }
}

RenderedImage LensWarp::Warp(const RenderedImage& rendering) const {
  RenderedImage image;
  image.width = width_;
  image.height = height_;
  image.rgb.resize(3 * centers_.size(), 0);
  image.depth.resize(centers_.size(), 0.0f);
  for (size_t i = 0; i < centers_.size(); ++i) {
    if (centers_[i].x() >= 0.0f) image.depth[i] = DepthAt(rendering, centers_[i]);
    float sums[3] = {0.0f, 0.0f, 0.0f};
    for (int s = 0; s < kSamples; ++s) {
      const Vector2f& sample = samples_[kSamples * i + s];
      if (sample.x() >= 0.0f) AddColor(rendering, sample, sums);
    }
    for (int k = 0; k < 3; ++k) {
      image.rgb[3 * i + k] = static_cast<uint8_t>(std::lround(sums[k] / kSamples));
    }
  }
  return image;
}

}  // namespace msc_vo
