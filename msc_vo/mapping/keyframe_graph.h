// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include "msc_vo/geometry/pose_covariance.h"
#include "msc_vo/map/map.h"
#include "msc_vo/pose_estimation/pose_graph.h"

namespace msc_vo {

/// What the covariance of two keyframes that see the same landmarks lacks: the errors of their
/// poses in a window, in the camera frame.
PoseCovariance CommonViewCovariance();

/// The keyframes of a map as a pose graph: the steps of odometry, pairs of keyframes that share
/// landmarks, and `loops`, whose keyframes are represented by those before them if they were
/// culled.
///
/// `systematic_length`, metres: 0 for a camera that is calibrated well, whose edges have
/// independent errors. Otherwise the graph drifts as a path with systematic errors does. Such an
/// error is common to all steps of a path, but edges are independent: so that the variances of the
/// steps add up to f times the systematic error of a path of L metres, SystematicCovariance(f L),
/// an edge of l metres gets SystematicCovariance(sqrt(l `systematic_length`)), where
/// `systematic_length` is f^2 L. Edges that bridge the same step then repeat one measurement, so
/// that the drift of each is multiplied by the number of them.
PoseGraph MakeKeyframeGraph(const Map& map, const std::vector<PoseGraphEdge>& loops,
                            double systematic_length);

}  // namespace msc_vo
