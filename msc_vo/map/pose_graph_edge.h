// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/geometry/pose_covariance.h"
#include "msc_vo/geometry/rigid3.h"
#include "msc_vo/map/landmark.h"

namespace msc_vo {

/// A measured pose of one keyframe relative to another.
struct PoseGraphEdge {
  KeyframeId from = kNoId;
  KeyframeId to = kNoId;
  Rigid3 to_from_from;  ///< camera to camera
  /// Of `to_from_from`, in the tangent of Rigid3Manifold; positive definite.
  PoseCovariance covariance = PoseCovariance::Zero();
};

}  // namespace msc_vo
