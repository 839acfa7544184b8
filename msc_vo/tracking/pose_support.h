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

/// Landmarks of a map that are in view of a frame at a place, and those of them that it matches.
struct MatchCounts {
  PerKind<int> in_view;
  int num_matched = 0;
};

/// Landmarks in view at a place that the frame can match, as compared with another place: of each
/// kind at most as many as it has features, or as are in view at the other place, if that is more.
/// A map of several visits has more landmarks in view than a frame can match.
int NumMatchable(const Frame& frame, const MatchCounts& place, const MatchCounts& other);

/// Whether the ratio of matched to matchable landmarks at a place is at least half of the ratio of
/// matched landmarks to those in view at another place. The same place, seen from another
/// direction, has a lower ratio, and one that looks alike a ratio that is lower still
/// (docs/lab/tracking.md).
bool HasComparableMatchRatio(const Frame& frame, const MatchCounts& place,
                             const MatchCounts& other);

/// Whether the depth images of the frame and of its reference keyframe contradict its pose in more
/// cells (NumFreeSpaceViolations) than its Support.
bool ContradictsDepth(const TrackedFrame& tracked, const Map& map);

}  // namespace msc_vo
