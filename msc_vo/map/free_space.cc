// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/map/free_space.h"

#include <algorithm>
#include <cmath>

#include "msc_vo/bundle_adjustment/observation.h"

namespace msc_vo {

namespace {

// Inverse depth of the nearest surface in the four cells around a pixel; 0 if the image does not
// contain them, or one of them has no depth.
double NearestAround(const Frame& frame, const Eigen::Vector2d& pixel) {
  const Eigen::Vector2d cell =
      pixel.cwiseQuotient(DepthRanges::CellSize(frame.camera)) - Eigen::Vector2d(0.5, 0.5);
  if (!(cell.x() >= 0.0 && cell.y() >= 0.0 && cell.x() < DepthRanges::kColumns - 1 &&
        cell.y() < DepthRanges::kRows - 1)) {
    return 0.0;
  }
  const int column = static_cast<int>(cell.x()), row = static_cast<int>(cell.y());
  float nearest = 0.0f;
  for (const int dy : {0, 1}) {
    for (const int dx : {0, 1}) {
      const DepthRanges::Cell& neighbor = frame.depth_ranges.At(column + dx, row + dy);
      if (!neighbor.HasDepth()) return 0.0;
      nearest = std::max(nearest, neighbor.max_inverse_depth);
    }
  }
  return nearest;
}

// Depth of the nearest surface that `frame` shows around a point's pixel, over that of the point; 0
// if it is unknown.
double DepthRatio(const Frame& frame, const Eigen::Vector3d& point) {
  if (frame.depth_ranges.cells.empty() || !IsInFront(point)) return 0.0;
  const double nearest = NearestAround(frame, frame.camera.Project(point));
  return nearest > 0.0 ? 1.0 / (nearest * point.z()) : 0.0;
}

// Classify a point by its depth ratio.
bool IsFree(double ratio) { return ratio > 1.0 + DepthRanges::kTolerance; }
bool IsSurface(double ratio) { return std::abs(ratio - 1.0) <= DepthRanges::kTolerance; }

}  // namespace

bool IsInFreeSpace(const Frame& frame, const Eigen::Vector3d& point) {
  return IsFree(DepthRatio(frame, point));
}

bool ShowsSurface(const Frame& frame, const Eigen::Vector3d& point) {
  return IsSurface(DepthRatio(frame, point));
}

SurfaceAgreement CompareSurfaces(const Frame& a, const Frame& b, const Rigid3& b_from_a) {
  SurfaceAgreement agreement;
  if (a.depth_ranges.cells.empty() || b.depth_ranges.cells.empty()) return agreement;
  for (int row = 0; row < DepthRanges::kRows; ++row) {
    for (int column = 0; column < DepthRanges::kColumns; ++column) {
      const DepthRanges::Cell& cell = a.depth_ranges.At(column, row);
      if (!cell.HasDepth()) continue;
      const Eigen::Vector2d pixel = DepthRanges::CellCenter(a.camera, column, row);
      const Eigen::Vector3d surface =
          b_from_a * a.camera.BackProject(pixel, 1.0 / cell.min_inverse_depth);
      const double ratio = DepthRatio(b, surface);
      if (IsFree(ratio)) ++agreement.num_violations;
      if (IsSurface(ratio)) ++agreement.num_same;
    }
  }
  return agreement;
}

int NumFreeSpaceViolations(const Frame& a, const Frame& b, const Rigid3& b_from_a) {
  return std::max(CompareSurfaces(a, b, b_from_a).num_violations,
                  CompareSurfaces(b, a, b_from_a.Inverse()).num_violations);
}

}  // namespace msc_vo
