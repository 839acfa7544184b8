// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "msc_vo/bundle_adjustment/window_data.h"
#include "msc_vo/geometry/line_segment.h"

namespace msc_vo {

// What a window leaves of its observations when it is solved, in their sigmas without the noise of
// their landmarks: what the sensor is learnt from. Observations are named by their position in the
// window's lists.
class WindowResiduals {
 public:
  // Keeps a reference to `solved`. Throws std::out_of_range if an observation is of a keyframe or
  // landmark that the window does not have.
  explicit WindowResiduals(const WindowData& solved);

  const WindowData& window() const { return window_; }
  // Position of an observation's landmark in the window's list.
  int PointOf(size_t i) const { return points_[i]; }
  int LineOf(size_t i) const { return lines_[i]; }

  // Of a point's inverse depth; none if it was not measured, or behind the camera.
  std::optional<double> PointDepth(size_t i) const;
  // Of a line in the image, at both end points of the map line; none behind the camera.
  std::optional<Eigen::Vector2d> LinePixel(size_t i) const;
  // Of its inverse depth at the middle of the observed segment, less the line's offset; none if it
  // was not measured.
  std::optional<double> LineDepth(size_t i) const;

 private:
  const WindowData& window_;
  // By observation: its landmark, and where that is in the observing camera, metres.
  std::vector<int> points_, lines_;
  std::vector<Eigen::Vector3d> points_in_cam_;
  std::vector<LineSegment3> lines_in_cam_;
};

}  // namespace msc_vo
