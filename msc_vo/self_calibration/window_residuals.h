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

/// Residuals of the observations of an optimised window, in sigmas of the observations without the
/// noise of their landmarks. Self-calibration estimates the noise of the sensor from them.
/// Observations are addressed by their index in the lists of the window.
class WindowResiduals {
 public:
  /// Keeps a reference to `optimized`. Throws std::out_of_range if an observation refers to a
  /// keyframe or landmark that the window does not contain.
  explicit WindowResiduals(const WindowData& optimized);

  const WindowData& window() const { return window_; }
  /// Index in window().points of the landmark of point observation `i`.
  int PointIndex(size_t i) const { return points_[i]; }
  /// Index in window().lines of the landmark of line observation `i`.
  int LineIndex(size_t i) const { return lines_[i]; }

  /// Residual of the inverse depth of a point; std::nullopt if no depth was measured or the point
  /// lies behind the camera.
  std::optional<double> PointDepth(size_t i) const;
  /// Reprojection residuals of a line at both end points of the map line; std::nullopt if the line
  /// lies behind the camera.
  std::optional<Eigen::Vector2d> LinePixel(size_t i) const;
  /// Inverse-depth residual of a line at the midpoint of the observed segment, corrected for its
  /// depth offset; std::nullopt without a measured depth, behind the camera or along a viewing ray.
  std::optional<double> LineDepth(size_t i) const;

 private:
  const WindowData& window_;
  // Per observation: index of the landmark, and its position in the observing camera, metres.
  std::vector<int> points_, lines_;
  std::vector<Eigen::Vector3d> points_in_cam_;
  std::vector<LineSegment3> lines_in_cam_;
};

}  // namespace msc_vo
