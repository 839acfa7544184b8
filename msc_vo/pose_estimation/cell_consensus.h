// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>
#include <vector>

#include "msc_vo/pose_estimation/pose_optimization.h"

namespace msc_vo {

// What most of an image agrees on, and what moves by itself before it.
//
// Something near and textured may hold more matches than the room behind it, and they agree with
// each other. No test of single matches sees it: while it begins to move, a pose in between makes
// inliers of both. But it covers a part of the image only. So the image is cut into parts that have
// one vote each, however many matches they hold: how much worse a pose is for them than their own
// best one, and no more than a limit. The errors of a part that moves go the same way and add up,
// long before one of them is an outlier.
struct CellConsensus {
  Rigid3 cam_from_world;
  std::vector<bool> dynamic_cells;  // of ImageGrid: those that vote against the pose
};

// Searches the surroundings of `pose`, as far as the equations hold that are linear there; nullopt
// if no other pose has `options.consensus.min_cells` votes more. Deterministic.
std::optional<CellConsensus> FindCellConsensus(const PoseOptions& options, const PoseData& data,
                                               const Rigid3& pose);

}  // namespace msc_vo
