// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cmath>
#include <vector>

#include "msc_vo/bundle_adjustment/window_data.h"

namespace msc_vo {

/// Parameter blocks of a window during minimisation: points (3 numbers each), lines (6) and poses
/// (7), in one buffer.
///
/// Ceres eliminates the blocks of a group in the order of their addresses. One buffer makes that
/// order, and with it the rounding of sums, the same in every run.
class WindowState {
 public:
  explicit WindowState(const WindowData& data)
      : lines_(3 * data.points.size()), poses_(lines_ + 6 * data.lines.size()) {
    parameters_.reserve(poses_ + 7 * data.keyframes.size());
    const auto append = [this](const double* block, int size) {
      parameters_.insert(parameters_.end(), block, block + size);
    };
    for (const WindowData::Point& p : data.points) append(p.position.data(), 3);
    for (const WindowData::Line& l : data.lines) append(l.segment.start.data(), 6);
    for (const WindowData::Keyframe& k : data.keyframes) append(k.cam_from_world.params.data(), 7);
  }

  /// Parameter block of point, line or keyframe i of the data.
  double* PointBlock(size_t i) { return &parameters_[3 * i]; }
  double* LineBlock(size_t i) { return &parameters_[lines_ + 6 * i]; }
  double* PoseBlock(size_t i) { return &parameters_[poses_ + 7 * i]; }
  const double* PointBlock(size_t i) const { return &parameters_[3 * i]; }
  const double* LineBlock(size_t i) const { return &parameters_[lines_ + 6 * i]; }
  const double* PoseBlock(size_t i) const { return &parameters_[poses_ + 7 * i]; }

  /// Current value of point, line or keyframe pose i.
  Eigen::Vector3d Point(size_t i) const { return Eigen::Vector3d(PointBlock(i)); }
  LineSegment3 Line(size_t i) const {
    const double* block = LineBlock(i);
    return {Eigen::Vector3d(block), Eigen::Vector3d(block + 3)};
  }
  Rigid3 Pose(size_t i) const {
    Rigid3 pose;
    pose.params = Eigen::Matrix<double, 7, 1>(PoseBlock(i));
    return pose;
  }

  bool AllFinite() const {
    for (const double x : parameters_) {
      if (!std::isfinite(x)) return false;
    }
    return true;
  }

 private:
  size_t lines_;  // offset of the first line
  size_t poses_;  // offset of the first pose
  std::vector<double> parameters_;
};

}  // namespace msc_vo
