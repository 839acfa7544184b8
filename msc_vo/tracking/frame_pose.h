// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/matching/local_map.h"
#include "msc_vo/pose_estimation/pose_optimization.h"
#include "msc_vo/tracking/tracked_frame.h"
#include "msc_vo/tracking/tracker_options.h"

namespace msc_vo {

// What `last` saw, as candidates to be found again from `cam_from_world`: its landmarks where the
// map has them now, and its other features that have a depth, at their measured position. These
// carry the tracking where the map is thin.
LocalMap CandidatesFromFrame(const Map& map, const TrackedFrame& last,
                             const Rigid3& last_from_world, const Rigid3& cam_from_world);

// Matches `frame` with what `local` holds, within `radius` pixels, in addition to `known` matches,
// whose landmarks and features are not matched again. Returns both.
FrameMatches MatchLocalMap(const TrackerOptions& options, const Frame& frame, const LocalMap& local,
                           double radius, const FrameMatches& known);

// The inliers among the matches with landmarks.
FrameMatches LandmarkInliers(const FrameMatches& matches);

// Solves the pose problem of `frame` for `matches`, starting from *cam_from_world; marks inliers.
// map: where the landmarks of the matches are, for their noise. scale: factors of the sigmas of the
// frame's features.
PoseSummary EstimateFramePose(const PoseOptions& options, const Frame& frame, const Map& map,
                              const NoiseScale& scale, Rigid3* cam_from_world,
                              FrameMatches* matches);

}  // namespace msc_vo
