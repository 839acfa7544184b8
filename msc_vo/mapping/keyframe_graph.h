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
/// The graph drifts as odometry does. Its edges have independent errors, but the systematic error
/// of a path is common to all of its steps. To let a path of L metres drift by s times
/// SystematicCovariance(L) as a whole, a step of l metres gets the variance of s^2 l L metres^2:
/// `systematic_length` is s^2 L. Steps and pairs beside each other then repeat one measurement:
/// this part of their covariances is multiplied by the number of them. 0: all errors are
/// independent, as those of a camera that is calibrated well.
PoseGraph MakeKeyframeGraph(const Map& map, const std::vector<PoseGraphEdge>& loops,
                            double systematic_length);

}  // namespace msc_vo
