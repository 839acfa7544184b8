// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cmath>
#include <vector>

#include "msc_vo/bundle_adjustment/window_data.h"

namespace msc_vo {

// The numbers that the window problem may change, while it does: the parameter blocks of points
// (3 each), lines (6) and poses (7), in one buffer.
//
// One buffer, because Ceres eliminates the blocks of a group in the order of their addresses. So
// that is the order here, in every run, and sums round alike; vectors of their own would lie in
// memory as chance has it.
class WindowState {
 public:
  explicit WindowState(const WindowData& data)
      : lines_(3 * data.points.size()), poses_(lines_ + 6 * data.lines.size()) {
    numbers_.reserve(poses_ + 7 * data.keyframes.size());
    const auto append = [this](const double* block, int size) {
      numbers_.insert(numbers_.end(), block, block + size);
    };
    for (const WindowData::Point& p : data.points) append(p.position.data(), 3);
    for (const WindowData::Line& l : data.lines) append(l.segment.start.data(), 6);
    for (const WindowData::Keyframe& k : data.keyframes) append(k.cam_from_world.params.data(), 7);
  }

  // The parameter block of point, line or keyframe i of the data.
  double* PointBlock(size_t i) { return &numbers_[3 * i]; }
  double* LineBlock(size_t i) { return &numbers_[lines_ + 6 * i]; }
  double* PoseBlock(size_t i) { return &numbers_[poses_ + 7 * i]; }
  const double* PointBlock(size_t i) const { return &numbers_[3 * i]; }
  const double* LineBlock(size_t i) const { return &numbers_[lines_ + 6 * i]; }
  const double* PoseBlock(size_t i) const { return &numbers_[poses_ + 7 * i]; }

  // Their present values.
  Eigen::Vector3d Point(size_t i) const { return Eigen::Vector3d(&numbers_[3 * i]); }
  LineSegment3 Line(size_t i) const {
    const double* block = &numbers_[lines_ + 6 * i];
    return {Eigen::Vector3d(block), Eigen::Vector3d(block + 3)};
  }
  Rigid3 Pose(size_t i) const {
    Rigid3 pose;
    pose.params = Eigen::Matrix<double, 7, 1>(&numbers_[poses_ + 7 * i]);
    return pose;
  }

  bool AllFinite() const {
    for (const double x : numbers_) {
      if (!std::isfinite(x)) return false;
    }
    return true;
  }

 private:
  size_t lines_;  // where they begin
  size_t poses_;
  std::vector<double> numbers_;
};

}  // namespace msc_vo
