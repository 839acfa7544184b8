// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/sensor/surface_map.h"

#include <algorithm>
#include <cmath>

namespace msc_vo {

namespace {

// Smaller depths are no measurement, metres.
constexpr float kMinDepth = 1e-3f;
// Smallest depth of a surface in the colour camera, depths in the depth camera.
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

// Change of the inverse depth from pixel to pixel in one direction on a surface: central
// difference; one-sided if only one neighbour is on the surface; 0 if none is.
inline float Step(float before, float here, float after, float threshold) {
  const float first = here - before, second = after - here;
  // Factors instead of branches, so that the compiler can process several pixels at once.
  const float with_first = std::abs(first) <= threshold ? 1.0f : 0.0f;
  const float with_second = std::abs(second) <= threshold ? 1.0f : 0.0f;
  return (with_first * first + with_second * second) * (1.0f - 0.5f * with_first * with_second);
}

// Steps to the right and down of the pixels of a row.
void ComputeSteps(const float* above, const float* here, const float* below, int width,
                  float* right, float* down) {
#pragma GCC ivdep
  for (int u = 0; u < width; ++u) {
    const float threshold = EdgeThreshold(here[u]);
    right[u] = Step(here[u - 1], here[u], here[u + 1], threshold);
    down[u] = Step(above[u], here[u], below[u], threshold);
  }
}

// Turns steps between pixels into derivatives by the position.
void CorrectSteps(const cv::Vec4f* derivative, int width, float* right, float* down) {
#pragma GCC ivdep
  for (int u = 0; u < width; ++u) {
    const float x = right[u], y = down[u];
    right[u] = derivative[u][0] * x + derivative[u][1] * y;
    down[u] = derivative[u][2] * x + derivative[u][3] * y;
  }
}

}  // namespace

// Values of the pixels of a row.
struct SurfaceMap::Row {
  explicit Row(int width) : right(width), down(width), seen(width), cell(width) {}

  std::vector<float> right, down;  // derivatives of the inverse depth
  std::vector<float> seen;         // inverse depth, 0 if colour does not see the surface
  std::vector<int> cell;
};

void SurfaceMap::AddRow(const RegistrationGeometry& geometry, int v, const float* above,
                        const float* here, const float* below, Row* row) {
  const int width = geometry.width;
  ComputeSteps(above, here, below, width, row->right.data(), row->down.data());
  if (geometry.HasDepthLens()) {
    CorrectSteps(geometry.depth_derivative.ptr<cv::Vec4f>(v), width, row->right.data(),
                 row->down.data());
  }
  const float* const px = geometry.depth_x.Row(v);
  const float* const py = geometry.depth_y.Row(v);
  const float offset_y = geometry.HasDepthLens() ? 0.0f : static_cast<float>(v) - geometry.center.y();
  const float *right = row->right.data(), *down = row->down.data();
  const float ex = geometry.epipole.x(), ey = geometry.epipole.y(), ez = geometry.epipole.z();
  const RegistrationGeometry::Grid& grid = geometry.grid;
  const float scale = grid.cells_per_pixel;
  // Positions are limited to the grid, in cells.
  const float from_x = grid.origin.x() * scale, from_y = grid.origin.y() * scale;
  const float last_x = from_x + static_cast<float>(grid.width - 1);
  const float last_y = from_y + static_cast<float>(grid.height - 1);
  const float stride = static_cast<float>(grid.width);
  Plane* const to = planes.data() + static_cast<size_t>(v + 1) * (width + 2) + 1;
  float* const seen = row->seen.data();
  int* const cell = row->cell.data();
#pragma GCC ivdep
  for (int u = 0; u < width; ++u) {
    const float w = here[u], at_y = py[u] + offset_y;
    const float z = w - right[u] * px[u] - down[u] * at_y;
    const float area = 1.0f + right[u] * ex + down[u] * ey + z * ez;
    const float relative_depth = 1.0f + w * ez;
    const float margin =
        std::min(w, std::min(area - kMinArea, relative_depth - kMinRelativeDepth));
    const float inverse_area = margin > 0.0f ? 1.0f / area : 0.0f;
    to[u] = {right[u] * inverse_area, down[u] * inverse_area, z * inverse_area, 0.0f};
    const float inverse_depth = scale / relative_depth;
    const float x = (px[u] + w * ex) * inverse_depth, y = (at_y + w * ey) * inverse_depth;
    const float column = std::min(last_x, std::max(from_x, x)) - from_x;
    const float line = std::min(last_y, std::max(from_y, y)) - from_y;
    cell[u] = static_cast<int>(static_cast<float>(static_cast<int>(line)) * stride +
                               static_cast<float>(static_cast<int>(column)));
    seen[u] = margin > 0.0f ? w : 0.0f;
  }
  for (int u = 0; u < width; ++u) {
    float& near = nearest[cell[u]];
    near = std::max(near, seen[u]);
  }
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

void SurfaceMap::Compute(const RegistrationGeometry& geometry, const cv::Mat& depth) {
  const int width = geometry.width, height = geometry.height;
  planes.resize(static_cast<size_t>(width + 2) * (height + 2));
  std::fill(planes.begin(), planes.begin() + width + 2, Plane{});
  std::fill(planes.end() - width - 2, planes.end(), Plane{});
  for (int v = 1; v <= height; ++v) {
    Plane* const row = planes.data() + static_cast<size_t>(v) * (width + 2);
    row[0] = row[width + 1] = Plane{};
  }
  nearest.assign(static_cast<size_t>(geometry.grid.width) * geometry.grid.height, 0.0f);
  Row row(width);
  // Inverse depths of rows v - 1, v and v + 1 are elements v, v + 1 and v + 2, modulo 3.
  std::vector<float> rows[3];
  for (std::vector<float>& values : rows) values.assign(width + 2, kNone);
  const float offset = geometry.inverse_depth_offset;
  InvertRow(depth.ptr<float>(0), width, offset, rows[1].data() + 1);
  for (int v = 0; v < height; ++v) {
    std::vector<float>& below = rows[(v + 2) % 3];
    if (v + 1 < height) {
      InvertRow(depth.ptr<float>(v + 1), width, offset, below.data() + 1);
    } else {
      std::fill(below.begin(), below.end(), kNone);
    }
    AddRow(geometry, v, rows[v % 3].data() + 1, rows[(v + 1) % 3].data() + 1, below.data() + 1,
           &row);
  }
  SpreadNearest(geometry.grid);
}

}  // namespace msc_vo
