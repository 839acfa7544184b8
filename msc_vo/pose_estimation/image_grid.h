// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include <Eigen/Core>

#include "msc_vo/camera/pinhole_camera.h"
#include "msc_vo/geometry/line_segment.h"

namespace msc_vo {

// The parts that an image is cut into for votes on its pose, numbered row by row.
class ImageGrid {
 public:
  ImageGrid(int columns, int rows, const PinholeCamera& camera)
      : columns_(columns),
        rows_(rows),
        per_pixel_x_(columns / static_cast<double>(camera.width)),
        per_pixel_y_(rows / static_cast<double>(camera.height)) {}

  int size() const { return columns_ * rows_; }
  // Of a pixel outside the image, where undistortion moves some, the nearest.
  int CellOf(const Eigen::Vector2d& pixel) const;
  // Of a segment, where it must be one: that of its middle.
  int CellOf(const LineSegment2& segment) const { return CellOf(segment.Midpoint()); }
  // Those that a segment runs through, looked up four times per part; in its order.
  std::vector<int> CellsOf(const LineSegment2& segment) const;
  // Centre of a part, as a share of the image's width and height.
  Eigen::Vector2d CenterOf(int part) const {
    return {(part % columns_ + 0.5) / columns_, (part / columns_ + 0.5) / rows_};
  }

 private:
  int columns_;
  int rows_;
  double per_pixel_x_;
  double per_pixel_y_;
};

}  // namespace msc_vo
