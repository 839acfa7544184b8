// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <map>
#include <vector>

#include "msc_vo/geometry/rigid3.h"
#include "msc_vo/map/landmark.h"
#include "msc_vo/map/pose_graph_edge.h"

namespace msc_vo {

/// Poses of keyframes (cam_from_world) and what is known between them.
struct PoseGraph {
  std::map<KeyframeId, Rigid3> poses;
  std::vector<PoseGraphEdge> edges;  ///< between keyframes of `poses`
};

/// Least squares over all edges; the first keyframe is held fixed. Returns the squared norm of the
/// whitened residual of each edge at the solution, which has six rows; empty, and the poses as they
/// were, if the solver fails.
std::vector<double> OptimizePoseGraph(PoseGraph* graph);

}  // namespace msc_vo
