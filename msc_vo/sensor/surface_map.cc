// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/sensor/surface_map.h"

#include <algorithm>
#include <cmath>

namespace msc_vo {

namespace {

// Smaller depths are no measurement, metres.
constexpr float kMinDepth = 1e-3f;
// Smallest depth of a surface in the colour camera, as a ratio to that in the depth camera.
constexpr float kMinRelativeDepth = 0.01f;
// Smallest area of a depth pixel in the depth image at infinity, square pixels; negative if the
// colour camera sees the surface from behind.
constexpr float kMinArea = 1e-3f;
// Inverse depth of a pixel without depth, 1/metres: further from all others than any threshold.
constexpr float kNone = -1e9f;

// Inverse depths of a row.
void InvertRow(const float* depth, int width, float offset, float* to) {
#pragma GCC ivdep
  for (int u = 0; u < width; ++u) {
    const float z = depth[u];
    // The comparisons are false for NaN.
    const float w = z > kMinDepth ? 1.0f / z + offset : kNone;
    to[u] = w > 0.0f ? w : kNone;
  }
}

// Steps of the inverse depth between neighbours.
struct Steps {
  explicit Steps(int size) : change(size, 0.0f), is_surface(size, 0.0f) {}

  // From `before` to `after`.
  void Compute(const float* before, const float* after) {
    float* const to_change = change.data();
    float* const to_surface = is_surface.data();
    const int size = static_cast<int>(change.size());
#pragma GCC ivdep
    for (int i = 0; i < size; ++i) {
      const float step = after[i] - before[i];
      const float gap = std::abs(step);
      // As EdgeThreshold() of the nearer one says.
      const bool is_same =
          (gap <= kMaxSurfaceNoise) | (gap <= kMaxSurfaceRatio * std::max(before[i], after[i]));
      to_change[i] = is_same ? step : 0.0f;
      to_surface[i] = is_same ? 1.0f : 0.0f;
    }
  }

  std::vector<float> change;      // 0 if the two are not on one surface
  std::vector<float> is_surface;  // 1 if they are, or else 0
};

// Derivatives of the inverse depth in one direction: central differences; one-sided ones if only
// one neighbour is on the surface; 0 if none is.
void Differentiate(const Steps& steps_before, int first, const Steps& steps_after, int second,
                   std::vector<float>* derivatives) {
  const float* const before = steps_before.change.data() + first;
  const float* const after = steps_after.change.data() + second;
  const float* const has_before = steps_before.is_surface.data() + first;
  const float* const has_after = steps_after.is_surface.data() + second;
  float* const to = derivatives->data();
  const int size = static_cast<int>(derivatives->size());
#pragma GCC ivdep
  for (int u = 0; u < size; ++u) {
    to[u] = (before[u] + after[u]) * (1.0f - 0.5f * has_before[u] * has_after[u]);
  }
}

// Turns derivatives by pixels into derivatives by positions.
void CorrectDerivatives(const cv::Vec4f* matrix, int width, float* right, float* down) {
#pragma GCC ivdep
  for (int u = 0; u < width; ++u) {
    const float x = right[u], y = down[u];
    right[u] = matrix[u][0] * x + matrix[u][1] * y;
    down[u] = matrix[u][2] * x + matrix[u][3] * y;
  }
}

}  // namespace

// Values of the pixels of a row, whose first element belongs to pixel 0 unless stated otherwise.
struct SurfaceMap::Row {
  explicit Row(int width)
      : inverse_depth(width + 2, kNone),
        next(width + 2, kNone),
        sideways(width + 1),
        above(width),
        below(width),
        right(width),
        down(width),
        seen(width),
        cell(width) {}

  std::vector<float> inverse_depth, next;  // of the row and the one below, from pixel -1
  Steps sideways;                          // to the pixel from the one on its left
  Steps above, below;                      // from the row above, and to the one below
  std::vector<float> right, down;          // derivatives of the inverse depth
  std::vector<float> seen;                 // inverse depth; 0: colour does not see the surface
  std::vector<int> cell;                   // of the grid
};

void SurfaceMap::AddRow(const RegistrationGeometry& geometry, int v, Row* row) {
  const float* const px = geometry.depth_x.Row(v);
  const float* const py = geometry.depth_y.Row(v);
  const float offset_y = geometry.DepthRowOffset(v);
  const float ex = geometry.epipole.x(), ey = geometry.epipole.y(), ez = geometry.epipole.z();
  const float* const here = row->inverse_depth.data() + 1;
  const float *right = row->right.data(), *down = row->down.data();
  const size_t start = static_cast<size_t>(v + 1) * (geometry.width + 2) + 1;
  float *to_x = plane_x.data() + start, *to_y = plane_y.data() + start;
  float *to_1 = plane_1.data() + start, *seen = row->seen.data();
  const int width = geometry.width;
#pragma GCC ivdep
  for (int u = 0; u < width; ++u) {
    const float w = here[u], dx = right[u], dy = down[u];
    const float w_center = w - dx * px[u] - dy * (py[u] + offset_y);
    const float area = 1.0f + dx * ex + dy * ey + w_center * ez;
    const float margin =
        std::min(w, std::min(area - kMinArea, (1.0f - kMinRelativeDepth) + w * ez));
    const float scale = margin > 0.0f ? 1.0f / area : 0.0f;
    to_x[u] = dx * scale;
    to_y[u] = dy * scale;
    to_1[u] = w_center * scale;
    seen[u] = margin > 0.0f ? w : 0.0f;
  }
}

void SurfaceMap::AddToGrid(const RegistrationGeometry& geometry, int v, Row* row) {
  const float* const px = geometry.depth_x.Row(v);
  const float* const py = geometry.depth_y.Row(v);
  const float offset_y = geometry.DepthRowOffset(v);
  const float ex = geometry.epipole.x(), ey = geometry.epipole.y(), ez = geometry.epipole.z();
  const RegistrationGeometry::Grid& grid = geometry.grid;
  const float scale = grid.cells_per_pixel;
  // Positions are limited to the grid, in cells.
  const float from_x = grid.origin.x() * scale, from_y = grid.origin.y() * scale;
  const float last_x = from_x + static_cast<float>(grid.width - 1);
  const float last_y = from_y + static_cast<float>(grid.height - 1);
  const float stride = static_cast<float>(grid.width);
  const float* const seen = row->seen.data();
  int* const cell = row->cell.data();
  const int width = geometry.width;
#pragma GCC ivdep
  for (int u = 0; u < width; ++u) {
    const float w = seen[u];
    const float inverse_depth = scale / (1.0f + w * ez);
    const float x = (px[u] + w * ex) * inverse_depth;
    const float y = (py[u] + offset_y + w * ey) * inverse_depth;
    const int column = static_cast<int>(std::min(last_x, std::max(from_x, x)) - from_x);
    const int line = static_cast<int>(std::min(last_y, std::max(from_y, y)) - from_y);
    cell[u] = static_cast<int>(static_cast<float>(line) * stride + static_cast<float>(column));
  }
  float* const to = nearest.data();
  for (int u = 0; u < width; ++u) to[cell[u]] = std::max(to[cell[u]], seen[u]);
}

void SurfaceMap::SpreadNearest(const RegistrationGeometry::Grid& grid) {
  // The border cells have the surfaces outside the grid, too.
  constexpr int kBorder = 2;
  for (int y = 0; y < grid.height; ++y) {
    float* const row = nearest.data() + static_cast<size_t>(y) * grid.width;
    const bool is_border = y < kBorder || y >= grid.height - kBorder;
    std::fill(row, row + (is_border ? grid.width : kBorder), 0.0f);
    std::fill(row + grid.width - kBorder, row + grid.width, 0.0f);
  }
  for (int y = 0; y + 1 < grid.height; ++y) {
    float* const row = nearest.data() + static_cast<size_t>(y) * grid.width;
    const float* const below = row + grid.width;
#pragma GCC ivdep
    for (int x = 0; x + 1 < grid.width; ++x) {
      row[x] = std::max(std::max(row[x], row[x + 1]), std::max(below[x], below[x + 1]));
    }
  }
}

void SurfaceMap::Reset(const RegistrationGeometry& geometry) {
  const int stride = geometry.width + 2;
  const size_t size = static_cast<size_t>(stride) * (geometry.height + 2);
  for (std::vector<float>* const plane : {&plane_x, &plane_y, &plane_1}) {
    plane->resize(size);
    std::fill(plane->begin(), plane->begin() + stride, 0.0f);
    std::fill(plane->end() - stride, plane->end(), 0.0f);
    for (size_t row = stride; row < size; row += stride) {
      (*plane)[row] = (*plane)[row + stride - 1] = 0.0f;
    }
  }
  nearest.assign(static_cast<size_t>(geometry.grid.width) * geometry.grid.height, 0.0f);
}

void SurfaceMap::Compute(const RegistrationGeometry& geometry, const cv::Mat& depth) {
  Reset(geometry);
  const int width = geometry.width, height = geometry.height;
  const float offset = geometry.inverse_depth_offset;
  Row row(width);
  InvertRow(depth.ptr<float>(0), width, offset, row.next.data() + 1);
  for (int v = 0; v < height; ++v) {
    std::swap(row.inverse_depth, row.next);
    std::swap(row.above, row.below);
    if (v + 1 < height) {
      InvertRow(depth.ptr<float>(v + 1), width, offset, row.next.data() + 1);
    } else {
      std::fill(row.next.begin(), row.next.end(), kNone);
    }
    row.sideways.Compute(row.inverse_depth.data(), row.inverse_depth.data() + 1);
    row.below.Compute(row.inverse_depth.data() + 1, row.next.data() + 1);
    Differentiate(row.sideways, 0, row.sideways, 1, &row.right);
    Differentiate(row.above, 0, row.below, 0, &row.down);
    if (geometry.HasDepthLens()) {
      CorrectDerivatives(geometry.depth_derivative.ptr<cv::Vec4f>(v), width, row.right.data(),
                         row.down.data());
    }
    AddRow(geometry, v, &row);
    AddToGrid(geometry, v, &row);
  }
  SpreadNearest(geometry.grid);
}

}  // namespace msc_vo
