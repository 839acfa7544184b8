// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>
#include <vector>

#include "msc_vo/pose_estimation/image_grid.h"
#include "msc_vo/pose_estimation/pose_optimization.h"

namespace msc_vo {

/// A pose that most of the image agrees with, and the cells that contradict it.
///
/// Dynamic-object rejection by cell consensus: a near, textured object may hold more matches than
/// the static scene behind it, and these matches agree with each other. Chi-square tests of single
/// matches do not detect this, because a pose between the two motions makes inliers of both. But
/// the object covers only a part of the image. Therefore the image is divided into the cells of an
/// ImageGrid, and the score of a pose is summed over cells, each bounded, rather than over matches:
/// the score of a cell is the increase of its chi-square over that of the cell's own best pose.
/// The errors of the matches on a moving object have a common direction, so they add up in their
/// cell long before a single match becomes an outlier.
struct CellConsensus {
  Rigid3 cam_from_world;
  std::vector<bool> dynamic_cells;  ///< one per cell of the ImageGrid: contradicts the pose
};

/// The cells of an image of the camera.
ImageGrid ConsensusGrid(const PinholeCamera& camera);

/// Searches for a better pose in the neighbourhood of `pose` where the linearised equations are
/// valid. Returns std::nullopt unless the score of the best pose found improves by the limit of one
/// cell. The limit of a cell is inflated by the variance that the cells have in common, up to the
/// square of `options.max_frame_noise`. Deterministic.
std::optional<CellConsensus> FindCellConsensus(const PoseOptions& options, const PoseData& data,
                                               const Rigid3& pose);

}  // namespace msc_vo
