// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "msc_vo/bundle_adjustment/window_data.h"
#include "msc_vo/map/snapshot.h"

namespace msc_vo {

/// A copy of a map: its keyframes, landmarks and observations as those of a window.
struct PyMap {
  WindowData window;
  std::vector<double> timestamps;  ///< of the keyframes, seconds
  std::optional<Eigen::Quaterniond> world_from_axes;
};

PyMap CopyMap(const MapSnapshot& snapshot);

}  // namespace msc_vo
