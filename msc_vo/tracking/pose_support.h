// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/tracking/frame_pose.h"

namespace msc_vo {

/// Support of a pose by its inliers, in points.
double Support(const PoseSummary& pose);

/// Whether a large part of the features that should be visible support a pose, whose matches were
/// searched among `candidates`. Weaker support could arise from random matches.
bool IsClear(const FramePose& pose, const LocalMap& candidates);

/// Whether a pose far from the prediction has so much more support than one near it that it
/// replaces it. If either has `min_matches` inliers that are confirmed static, these are compared,
/// because a pose that follows a dynamic object, or that only random matches support, has few.
bool IsClearlyBetter(const TrackerOptions& options, const PoseSummary& far,
                     const PoseSummary& near);

/// How many of so many landmarks `in_view` a frame can match: each feature matches one at most, and
/// a map of several visits has more landmarks than a frame has features.
int NumMatchable(const PerKind<int>& in_view, const Frame& frame);

/// Smallest ratio of matched to matchable landmarks at a place, relative to the ratio at the place
/// that it is compared with: the same place may be seen from another direction.
constexpr double kMinRelativeMatchRatio = 0.5;

/// Whether the ratio of the inliers `found` to the matchable landmarks at `place` is at least half
/// of the same ratio in the current map, where the frame is `tracked`. At another place that looks
/// alike it is lower (docs/lab/tracking.md).
bool HasComparableMatchRatio(const FrameMatches& found, const LocalMap& place,
                             const TrackedFrame& tracked);

/// Whether the depth images of the frame and of its reference keyframe contradict its pose in more
/// cells (NumFreeSpaceViolations) than its Support.
bool ContradictsDepth(const TrackedFrame& tracked, const Map& map);

}  // namespace msc_vo
