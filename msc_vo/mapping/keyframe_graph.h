// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include "msc_vo/geometry/pose_covariance.h"
#include "msc_vo/map/map.h"
#include "msc_vo/map/map_contents.h"
#include "msc_vo/pose_estimation/pose_graph.h"

namespace msc_vo {

/// What the covariance of two keyframes that see the same landmarks lacks: the errors of their
/// poses in a window, in the camera frame.
PoseCovariance CommonViewCovariance();

/// The systematic errors that explain a loop: a factor f times those of the model for a path of L
/// metres on which the camera turns by W radians, SystematicCovariance(L, W).
struct SystematicDrift {
  double length = 0.0;  ///< f^2 L, metres
  double turn = 0.0;    ///< f^2 W, radians
};

/// The keyframes of a map as a pose graph: the steps of odometry, pairs of keyframes that share
/// landmarks, and `loops`, whose keyframes are represented by those before them if they were
/// culled: the edge then has the drift between both, too.
///
/// `systematic`: zero for a camera that is calibrated well, whose edges have independent errors.
/// Otherwise the graph drifts as a path with systematic errors does. Such an error is common to all
/// steps of a path, but edges are independent: an edge of l metres and w radians gets
/// SystematicCovariance(f sqrt(L l), f sqrt(W w)), so that the variances of the steps add up to
/// those of the whole path. Edges that bridge the same step then repeat one measurement, so that
/// the drift of each is multiplied by the number of them.
PoseGraph MakeKeyframeGraph(const Map& map, const std::vector<PoseGraphEdge>& loops,
                            const SystematicDrift& systematic);

/// `loops` between keyframes that are in `submaps`, as MakeKeyframeGraph() represents them: what a
/// map file keeps of them.
std::vector<PoseGraphEdge> LoopsBetweenKeyframes(const std::vector<SavedSubMap>& submaps,
                                                 const std::vector<PoseGraphEdge>& loops);

}  // namespace msc_vo
