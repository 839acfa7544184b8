// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/sensor/depth_registration.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

#include "msc_vo/sensor/depth_units.h"
#include "msc_vo/sensor/hole_removal.h"
#include "msc_vo/sensor/surface_map.h"

namespace msc_vo {

namespace {

// Largest distance of a surface from where it was expected, depth pixels.
constexpr float kMaxPlaneDisplacement = 0.25f;
// Half the width of the holes through which the background is removed, depth pixels.
constexpr double kHoleRadius = 2.0;
// A position in the first row and column of the grid or of the planes, which have no depth.
constexpr float kFirst = 0.5f;

// Index of a position in rows of `stride` elements; all not negative.
inline int Index(float x, float y, float stride) {
  return static_cast<int>(static_cast<float>(static_cast<int>(y)) * stride +
                          static_cast<float>(static_cast<int>(x)));
}

// Inverse depth between those of two pixels: their mean on one surface; 0: none of them has a
// depth, also beside one that needs a search (a pixel in a thousand of those at edges); -1: needs a
// search.
inline float Middle(float first, float second) {
  const float gap = std::abs(first - second);
  const bool is_surface =
      (gap <= kMaxSurfaceNoise) | (gap <= kMaxSurfaceRatio * std::min(first, second));
  const float mean = is_surface ? 0.5f * (first + second) : -1.0f;
  return std::max(first, second) == 0.0f ? 0.0f : mean;
}

}  // namespace

// Viewing rays of some colour pixels of a row, and the surfaces that they may meet. Steps that
// compute one field after another overlap better in a processor than one that computes all.
struct DepthRegistration::Strip {
  static constexpr int kSize = 256;

  int first, size;           // pixels
  float x[kSize], y[kSize];  // positions at infinity in the depth image
  float z[kSize];            // (A p)_z
  float nearest[kSize];      // largest inverse depth around, of the depth camera
  int index[kSize];          // of the cell of the grid, then of the plane
};

template <bool kColorLens>
void DepthRegistration::ComputeRays(int y, Strip* strip) const {
  const float* const px = geometry_.color_x.Row(y) + strip->first;
  const float* const py = geometry_.color_y.Row(y) + strip->first;
  const float constant_y = kColorLens ? 0.0f : static_cast<float>(y);
  const Eigen::Matrix3f& m = geometry_.matrix;
  const float xx = m(0, 0), xy = m(0, 1), x1 = m(0, 2) + m(0, 1) * constant_y;
  const float yx = m(1, 0), yy = m(1, 1), y1 = m(1, 2) + m(1, 1) * constant_y;
  const float zx = m(2, 0), zy = m(2, 1), z1 = m(2, 2) + m(2, 1) * constant_y;
  const RegistrationGeometry::Grid& grid = geometry_.grid;
  const float scale = grid.cells_per_pixel;
  // Positions are limited to cells that have a right and a lower neighbour, in cells.
  const float from_x = grid.origin.x() * scale + 0.5f, from_y = grid.origin.y() * scale + 0.5f;
  const float first_column = from_x + kFirst, first_row = from_y + kFirst;
  const float last_column = from_x + static_cast<float>(grid.width - 2);
  const float last_row = from_y + static_cast<float>(grid.height - 2);
  const float stride = static_cast<float>(grid.width);
  const int size = strip->size;
#pragma GCC ivdep
  for (int i = 0; i < size; ++i) {
    // Without a lens, the row is part of the last coefficients.
    const float z = zx * px[i] + (kColorLens ? zy * py[i] + z1 : z1);
    const float inverse_z = 1.0f / z;
    const float x_inf = (xx * px[i] + (kColorLens ? xy * py[i] + x1 : x1)) * inverse_z;
    const float y_inf = (yx * px[i] + (kColorLens ? yy * py[i] + y1 : y1)) * inverse_z;
    const float column = std::min(last_column, std::max(first_column, x_inf * scale)) - from_x;
    const float row = std::min(last_row, std::max(first_row, y_inf * scale)) - from_y;
    strip->x[i] = x_inf;
    strip->y[i] = y_inf;
    strip->z[i] = z;
    strip->index[i] = Index(column, row, stride);
  }
}

template <bool kDepthLens>
void DepthRegistration::FindPlanes(const SurfaceMap& surfaces, Strip* strip) const {
  const float ex = geometry_.epipole.x(), ey = geometry_.epipole.y(), ez = geometry_.epipole.z();
  // Positions are limited to depth pixels and the border around them; rounded.
  const float to_x = geometry_.center.x() + 1.5f, to_y = geometry_.center.y() + 1.5f;
  const float first_x = kFirst - to_x, first_y = kFirst - to_y;
  const float last_x = static_cast<float>(geometry_.width + 1) - to_x;
  const float last_y = static_cast<float>(geometry_.height + 1) - to_y;
  const float stride = static_cast<float>(geometry_.width + 2);
  const float* const nearest = surfaces.nearest.data();
  const int size = strip->size;
#pragma GCC ivdep
  for (int i = 0; i < size; ++i) {
    const float near = nearest[strip->index[i]];
    const float x = strip->x[i], y = strip->y[i];
    float at_x = x + near * (x * ez - ex), at_y = y + near * (y * ez - ey);
    if (kDepthLens) {
      const Eigen::Vector2f offset = geometry_.DepthLensOffset(at_x, at_y);
      at_x += offset.x();
      at_y += offset.y();
    }
    strip->nearest[i] = near;
    strip->index[i] = Index(std::min(last_x, std::max(first_x, at_x)) + to_x,
                            std::min(last_y, std::max(first_y, at_y)) + to_y, stride);
  }
}

void DepthRegistration::MeetPlanes(const SurfaceMap& surfaces, const Strip& strip,
                                   float* row) const {
  const float ez = geometry_.epipole.z();
  const float tolerance = kMaxPlaneDisplacement * geometry_.inverse_depth_per_pixel;
  const float *plane_x = surfaces.plane_x.data(), *plane_y = surfaces.plane_y.data();
  const float* const plane_1 = surfaces.plane_1.data();
  const int size = strip.size;
#pragma GCC ivdep
  for (int i = 0; i < size; ++i) {
    const int k = strip.index[i];
    const float w = plane_x[k] * strip.x[i] + plane_y[k] * strip.y[i] + plane_1[k];
    const float near = strip.nearest[i];
    // Difference to the inverse depth with which the plane was found.
    const float difference = std::abs(w * (1.0f + near * ez) - near);
    const float inverse_depth = w * strip.z[i];
    const float found =
        difference <= std::min(tolerance, kMaxSurfaceRatio * near) ? inverse_depth : -1.0f;
    row[strip.first + i] = near > 0.0f ? found : 0.0f;
  }
}

float DepthRegistration::Intersect(const SurfaceMap& surfaces, const Eigen::Vector2f& infinity,
                                   float near) const {
  const Eigen::Vector3f& e = geometry_.epipole;
  const int stride = geometry_.width + 2;
  const Eigen::Array2f last(static_cast<float>(geometry_.width + 1),
                            static_cast<float>(geometry_.height + 1));
  Eigen::Vector2f at = infinity + near * (infinity * e.z() - e.head<2>());
  Eigen::Vector2f to_plane = geometry_.center + Eigen::Vector2f::Constant(1.0f);
  if (geometry_.HasDepthLens()) to_plane += geometry_.DepthLensOffset(at.x(), at.y());
  // The pixels whose squares contain the expected position, then those around the point where the
  // last plane is met.
  float nearest = 0.0f;
  for (int k = 0; k < 2; ++k) {
    const Eigen::Array2f position = (at + to_plane).array();
    const Eigen::Array2i first = (position + (1.0f - kHalfSide)).max(kFirst).min(last).cast<int>();
    const Eigen::Array2i end = (position + kHalfSide).max(kFirst).min(last).cast<int>();
    for (int v = first.y(); v <= end.y(); ++v) {
      for (int u = first.x(); u <= end.x(); ++u) {
        const float w = surfaces.InverseDepth(v * stride + u, infinity.x(), infinity.y());
        if (!(w > 0.0f)) continue;
        at = (infinity - w * e.head<2>()) / (1.0f - w * e.z());
        const Eigen::Vector2f offset =
            at + to_plane - Eigen::Vector2f(static_cast<float>(u), static_cast<float>(v));
        if (offset.lpNorm<Eigen::Infinity>() <= kHalfSide) nearest = std::max(nearest, w);
      }
    }
    if (nearest > 0.0f) break;
  }
  return nearest;
}

float DepthRegistration::Search(const SurfaceMap& surfaces, int x, int y) const {
  const Eigen::Vector3f ray = geometry_.matrix * geometry_.ColorPixel(x, y).homogeneous();
  if (ray.z() < kMinRayZ) return 0.0f;
  const Eigen::Vector2f infinity = ray.head<2>() / ray.z();
  const int stride = geometry_.grid.width;
  const float* const cell = surfaces.nearest.data() + geometry_.grid.IndexAround(infinity);
  // The nearest surface of the cell, then those of its neighbours.
  const float expected = *cell;
  float best = Intersect(surfaces, infinity, expected);
  if (best > 0.0f) return best * ray.z();
  const float tolerance = kMaxPlaneDisplacement * geometry_.inverse_depth_per_pixel;
  float previous = expected;
  for (const int offset : {-1, 1, -stride, stride}) {
    const float near = cell[offset];
    if (near == 0.0f || std::abs(near - expected) <= tolerance ||
        std::abs(near - previous) <= tolerance) {
      continue;
    }
    previous = near;
    best = std::max(best, Intersect(surfaces, infinity, near));
  }
  return best * ray.z();
}

void DepthRegistration::InterpolateColumns(const float* sparse, float* row) const {
  const int size = geometry_.color_width / 2;
#pragma GCC ivdep
  for (int i = 0; i < size; ++i) {
    row[2 * i] = sparse[i];
    row[2 * i + 1] = Middle(sparse[i], sparse[i + 1]);
  }
  if (geometry_.color_width % 2 == 1) row[geometry_.color_width - 1] = sparse[size];
}

void DepthRegistration::InterpolateRows(const std::vector<float>& above,
                                        const std::vector<float>& below, float* row) const {
  const float *first = above.data(), *second = below.data();
  const int size = geometry_.color_width;
#pragma GCC ivdep
  for (int x = 0; x < size; ++x) row[x] = Middle(first[x], second[x]);
}

void DepthRegistration::SearchRow(const SurfaceMap& surfaces, int y, float* row) const {
  constexpr int kGroup = 4;  // pixels that are tested together
  const int size = geometry_.color_width;
  for (int first = 0; first < size; first += kGroup) {
    // The signs of all; the row has more elements than pixels.
    uint64_t bits[kGroup / 2];
    std::memcpy(bits, row + first, sizeof(bits));
    if (((bits[0] | bits[1]) & 0x8000000080000000u) == 0) continue;
    for (int x = first; x < std::min(first + kGroup, size); ++x) {
      if (row[x] < 0.0f) row[x] = Search(surfaces, x, y);
    }
  }
}

void DepthRegistration::ComputeRow(const SurfaceMap& surfaces, int y, float* sparse,
                                   float* row) const {
  const auto compute_rays = geometry_.HasColorLens() ? &DepthRegistration::ComputeRays<true>
                                                     : &DepthRegistration::ComputeRays<false>;
  const auto find_planes = geometry_.HasDepthLens() ? &DepthRegistration::FindPlanes<true>
                                                    : &DepthRegistration::FindPlanes<false>;
  const int size = geometry_.color_x.values.cols;
  float* const to = geometry_.color_step == 1 ? row : sparse;
  Strip strip;
  for (strip.first = 0; strip.first < size; strip.first += Strip::kSize) {
    strip.size = std::min(Strip::kSize, size - strip.first);
    (this->*compute_rays)(y, &strip);
    (this->*find_planes)(surfaces, &strip);
    MeetPlanes(surfaces, strip, to);
  }
  if (geometry_.color_step == 2) InterpolateColumns(sparse, row);
}

cv::Mat DepthRegistration::Register(const cv::Mat& depth) const {
  if (depth.type() != CV_32FC1 || depth.cols != geometry_.width || depth.rows != geometry_.height) {
    throw std::invalid_argument(
        "DepthRegistration: the depth image must be CV_32FC1 and of the "
        "size of the depth camera");
  }
  const std::string error = DepthUnitsError(depth);
  if (!error.empty()) throw std::invalid_argument("DepthRegistration: " + error);
  if (geometry_.grid.width == 0) {  // the cameras look past each other
    return cv::Mat::zeros(geometry_.color_height, geometry_.color_width, CV_32FC1);
  }
  static thread_local SurfaceMap surfaces;
  surfaces.Compute(geometry_, depth);
  const cv::Size size(geometry_.color_width, geometry_.color_height);
  HoleRemoval target(size, std::max(1, cvRound(kHoleRadius * geometry_.magnification)));
  // The last element, behind the last pixel, has no depth.
  std::vector<float> sparse(geometry_.color_x.values.cols + 1, 0.0f);
  std::vector<float> above(size.width), next(size.width);
  for (int y = 0; y < size.height; ++y) {
    float* const row = target.NextRow();
    const bool is_between = y % geometry_.color_step == 1 && y + 1 < size.height;
    if (is_between) {
      ComputeRow(surfaces, y + 1, sparse.data(), next.data());
      InterpolateRows(above, next, row);
      above.swap(next);
    } else if (y > 0 && y % geometry_.color_step == 0 && geometry_.color_step == 2) {
      std::copy(above.begin(), above.end(), row);
    } else {
      ComputeRow(surfaces, y, sparse.data(), row);
      if (y == 0) std::copy(row, row + size.width, above.begin());
    }
    SearchRow(surfaces, y, row);
    target.AddRow();
  }
  return target.TakeDepth();
}

}  // namespace msc_vo
