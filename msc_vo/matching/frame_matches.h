// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/geometry/pose_covariance.h"
#include "msc_vo/geometry/rigid3.h"
#include "msc_vo/map/landmark.h"
#include "msc_vo/map/landmark_kinds.h"
#include "msc_vo/matching/landmark_matchers.h"

namespace msc_vo {

/// The matches of one frame; each feature occurs at most once.
using FrameMatches = ByKind<Matches>;

/// Pose of a frame in another part of the map than the one that it is tracked in: in an inactive
/// map, that of an older segment, or in a part of its own map that it shares no landmarks with.
struct Revisit {
  KeyframeId reference = kNoId;  ///< of that part
  Rigid3 cam_from_reference;
  /// Of the pose in the world of the reference, in the camera frame (CameraCovariance()).
  PoseCovariance covariance = PoseCovariance::Zero();
  FrameMatches matches;  ///< inliers among the landmarks of that part
};

}  // namespace msc_vo
