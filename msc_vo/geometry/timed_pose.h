// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <algorithm>
#include <vector>

#include "msc_vo/geometry/rigid3.h"

namespace msc_vo {

/// One pose of a trajectory: camera in world, as in a trajectory file.
struct TimedPose {
  double timestamp = 0.0;  ///< seconds
  Rigid3 world_from_cam;
  /// False if the pose is predicted or interpolated in time, not estimated from an image.
  bool is_estimated = true;
  int segment = 0;  ///< part of the run that was tracked in a map of its own
  /// The segment whose world the pose is in. The transform between two worlds is unknown.
  int world = 0;
};

/// Sorts poses by time; those with the same time stay in their order.
inline void SortByTime(std::vector<TimedPose>* poses) {
  std::stable_sort(poses->begin(), poses->end(), [](const TimedPose& a, const TimedPose& b) {
    return a.timestamp < b.timestamp;
  });
}

/// Returns one member of all items: TimestampsOf(poses, &TimedPose::timestamp).
template <typename Item>
std::vector<double> TimestampsOf(const std::vector<Item>& items, double Item::*timestamp) {
  std::vector<double> timestamps;
  timestamps.reserve(items.size());
  for (const Item& item : items) timestamps.push_back(item.*timestamp);
  return timestamps;
}

}  // namespace msc_vo
