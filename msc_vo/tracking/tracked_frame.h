// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "msc_vo/frame/frame.h"
#include "msc_vo/geometry/camera_velocity.h"
#include "msc_vo/geometry/rigid3.h"
#include "msc_vo/map/landmark_kinds.h"
#include "msc_vo/map/last_tracked_pose.h"
#include "msc_vo/map/noise_scale.h"
#include "msc_vo/matching/frame_matches.h"
#include "msc_vo/matching/map_relocalization.h"
#include "msc_vo/pose_estimation/pose_optimization.h"
#include "msc_vo/tracking/tracking_status.h"

namespace msc_vo {

/// Time of the stages of tracking one frame, milliseconds.
struct TrackingTimes {
  double matching = 0.0;
  double pose = 0.0;  ///< motion-only bundle adjustment

  TrackingTimes& operator+=(const TrackingTimes& other) {
    matching += other.matching;
    pose += other.pose;
    return *this;
  }

  template <typename Archive>
  void Serialize(Archive& archive) {
    archive.Fields(*this, matching, pose);
  }
};

/// Contribution of a tracked frame to local mapping.
struct KeyframeProposal {
  bool is_due = false;  ///< the frame is to become a keyframe
  /// In the previous map, if the frame begins a new one.
  std::optional<LastTrackedPose> last_tracked;
  /// Velocity at the previous frame if that became a keyframe, from the frames before and after it.
  std::optional<CameraVelocity> previous_velocity;
  /// Landmarks that were predicted to be visible, matched ones included; for culling.
  PerKind<std::vector<LandmarkId>> visible;

  template <typename Archive>
  void Serialize(Archive& archive) {
    archive.Fields(*this, is_due, last_tracked, previous_velocity, visible);
  }
};

/// Whether a frame begins a segment of the run, with a map of its own.
enum class SegmentStart {
  kNone,
  kFirst,      ///< the first frame with enough features
  kAfterLoss,  ///< the map of the segment before could not be found again
  kReplacing,  ///< the same, and no frame but the first was tracked in that map: it is discarded
};

/// Result of tracking one frame. The pose is stored relative to a keyframe, because the mapper may
/// move that keyframe later and the frame moves with it.
struct TrackedFrame {
  std::shared_ptr<const Frame> frame;  ///< with rolling-shutter compensation
  TrackingStatus status = TrackingStatus::kLost;
  bool relocalized = false;  ///< the pose was found by relocalisation in a keyframe
  bool searched = false;     ///< the pose was found by the search for large motions
  /// kNoId: the frame begins a map, or there is none, and cam_from_reference is cam_from_world.
  KeyframeId reference = kNoId;
  Rigid3 cam_from_reference;
  Rigid3 cam_from_world;   ///< with the reference as in the snapshot
  FrameMatches matches;    ///< inliers among the landmarks
  NoiseScale noise_scale;  ///< of the sigmas of its features
  PoseSummary pose;
  /// Matches on dynamic objects, in the pose optimisation that found most of them.
  int num_dynamic = 0;
  /// One per cell of the ImageGrid: whether it contains a dynamic object, in the same optimisation.
  /// Empty if there is no such object.
  std::vector<bool> dynamic_cells;
  SegmentStart segment_start = SegmentStart::kNone;
  /// The same frame in the map of an older segment, if it was found there.
  std::optional<MapRelocalization> in_inactive_map;
  KeyframeProposal keyframe;
  TrackingTimes times;

  template <typename Archive>
  void Serialize(Archive& archive) {
    archive.Fields(*this, frame, status, relocalized, searched, reference, cam_from_reference,
                   cam_from_world, matches, noise_scale, pose, num_dynamic, dynamic_cells,
                   segment_start, in_inactive_map, keyframe, times);
  }
};

}  // namespace msc_vo
