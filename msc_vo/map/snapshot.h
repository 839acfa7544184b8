// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include "msc_vo/bundle_adjustment/custom_factor.h"
#include "msc_vo/map/inactive_maps.h"
#include "msc_vo/map/map.h"
#include "msc_vo/map/noise_scale.h"
#include "msc_vo/map/plane_landmark.h"
#include "msc_vo/map/pose_graph_edge.h"

namespace msc_vo {

/// An estimate of the Manhattan axes of the scene.
struct AxesEstimate {
  Eigen::Quaterniond world_from_axes = Eigen::Quaterniond::Identity();
  double sigma = 0.0;      ///< standard deviation of the least certain direction, radians
  double deviation = 0.0;  ///< of the lines that were built along the axes, radians
};

/// The immutable map after one keyframe step. Any thread may read it.
struct MapSnapshot {
  Map map;
  MapPlanes planes;
  int world = 0;  ///< number of the segment that began the world of the map
  KeyframeId newest_keyframe = kNoId;
  int num_loops = 0;  ///< closed in the run so far
  /// Measured poses of closed loops, and of keyframes in known parts of the map; those of earlier
  /// sessions and of other maps included.
  std::vector<PoseGraphEdge> loops;
  NoiseScale noise_scale;     ///< self-calibrated
  double readout_time = 0.0;  ///< seconds, of the rolling-shutter compensation of its keyframes
  /// Calibration of its keyframes, which frames must have that are tracked in it; null: unknown.
  std::shared_ptr<const CameraIntrinsics> intrinsics;
  std::optional<AxesEstimate> axes;     ///< std::nullopt until they are found
  bool needs_axes = false;              ///< the next keyframe packet shall contain surface normals
  bool calibration_is_settled = false;  ///< self-calibration needs no further images
  /// Focal length, lens or registration of depth are more likely wrong than a calibration in
  /// general, and not corrected. Planes, which depend on them, are then not used beside points and
  /// lines: poses that agree with them would hide the error.
  bool calibration_is_doubted = false;
  InactiveMaps inactive_maps;            ///< of older segments that are not joined with this map
  std::vector<ExtraBlock> extra_blocks;  ///< as its windows have estimated them, in order of ids

  /// The map that knows the keyframe; nullptr: none.
  const Map* FindMapOf(KeyframeId keyframe) const {
    return map.KnowsKeyframe(keyframe) ? &map : msc_vo::FindMapOf(inactive_maps, keyframe);
  }
};
using MapSnapshotPtr = std::shared_ptr<const MapSnapshot>;

}  // namespace msc_vo
