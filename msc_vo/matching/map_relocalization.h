// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/geometry/pose_covariance.h"
#include "msc_vo/geometry/rigid3.h"
#include "msc_vo/map/landmark.h"
#include "msc_vo/matching/frame_matches.h"

namespace msc_vo {

/// Pose of a frame in an inactive map, that of an older segment.
struct MapRelocalization {
  KeyframeId reference = kNoId;  ///< of the inactive map
  Rigid3 cam_from_reference;
  /// Of the pose in the world of the inactive map, in the tangent of Rigid3Manifold.
  PoseCovariance covariance = PoseCovariance::Zero();
  FrameMatches matches;  ///< inliers among the landmarks of the inactive map

  template <typename Archive>
  void Serialize(Archive& archive) {
    archive.Fields(*this, reference, cam_from_reference, covariance, matches);
  }
};

}  // namespace msc_vo
