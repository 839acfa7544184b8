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

/// Landmarks of a map in view of a frame.
struct MatchCounts {
  /// That the frame can match: of each kind at most as many as it has features, of which a map of
  /// several visits has more.
  int num_matchable = 0;
  int num_matched = 0;
};

/// `in_view`: numbers of landmarks in view. `matches`: inliers.
MatchCounts CountMatches(const Frame& frame, const PerKind<int>& in_view,
                         const FrameMatches& matches);

/// Whether the ratio of matched to matchable landmarks at a place is at least half of that at
/// another place: the same place, seen from another direction, has a lower ratio, and one that
/// looks alike a ratio that is lower still (docs/lab/tracking.md).
bool HasComparableMatchRatio(const MatchCounts& place, const MatchCounts& other);

/// Whether the depth images of the frame and of its reference keyframe contradict its pose in more
/// cells (NumFreeSpaceViolations) than its Support.
bool ContradictsDepth(const TrackedFrame& tracked, const Map& map);

}  // namespace msc_vo
