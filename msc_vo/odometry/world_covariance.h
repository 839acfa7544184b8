// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>
#include <vector>

#include "msc_vo/map/path_covariance.h"
#include "msc_vo/map/snapshot.h"
#include "msc_vo/mapping/mapper.h"
#include "msc_vo/odometry/frame_result.h"
#include "msc_vo/odometry/pose_correction.h"

namespace msc_vo {

/// Covariances of the poses of a running odometry relative to the origins of their worlds.
class WorldCovariance {
 public:
  /// Sets FrameResult::world_covariance of a frame whose pose is in `map`, which knows its
  /// reference keyframe.
  void Set(const TrackedFrame& tracked, const MapSnapshotPtr& map, FrameResult* result);

 private:
  // Of the keyframes of the last map, relative to its origin.
  MapSnapshotPtr map_;
  std::optional<PathCovariances> keyframes_;
};

/// Sets FrameResult::world_covariance of frames with final poses and covariances, which are given
/// relative to the keyframes of the mapper.
void SetWorldCovariances(const Mapper& mapper, const std::vector<ReferencedPose>& poses,
                         std::vector<FrameResult>* frames);

}  // namespace msc_vo
