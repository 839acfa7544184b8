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
#include "msc_vo/map/plane_landmark.h"
#include "msc_vo/matching/frame_matches.h"
#include "msc_vo/pose_estimation/pose_optimization.h"
#include "msc_vo/tracking/tracking_status.h"

namespace msc_vo {

/// Time of the stages of tracking one frame, milliseconds.
struct TrackingTimes {
  double matching = 0.0;
  double pose = 0.0;  ///< motion-only bundle adjustment
};

/// Whether a frame begins a segment of the run, with a map of its own.
enum class SegmentStart {
  kNone,
  kFirst,      ///< the first frame with enough features
  kAfterLoss,  ///< the map of the segment before could not be found again
  kReplacing,  ///< the same, and no frame but the first was tracked in that map: it is discarded
};

/// Whether a frame is to become a keyframe, and what the mapper must know then.
struct KeyframeProposal {
  KeyframeId id = kNoId;  ///< of the keyframe; kNoId: the frame does not become one
  SegmentStart segment_start = SegmentStart::kNone;
  /// In the previous map, if the frame begins a new one.
  std::optional<LastTrackedPose> last_tracked;
  /// The same frame in another part of the maps, if it was found there.
  std::optional<Revisit> revisit;

  bool is_due() const { return id != kNoId; }
};

/// Result of tracking one frame. The pose is stored relative to a keyframe, because the mapper may
/// move that keyframe later and the frame moves with it.
struct TrackedFrame {
  /// With rolling-shutter compensation; a keyframe with its dynamic features marked.
  std::shared_ptr<const Frame> frame;
  TrackingStatus status = TrackingStatus::kLost;
  bool relocalized = false;       ///< the pose was found by relocalisation in a keyframe
  bool has_pose_factors = false;  ///< custom factors took part in its estimate
  /// kNoId: the frame begins a map, or there is none, and cam_from_reference is cam_from_world.
  KeyframeId reference = kNoId;
  Rigid3 cam_from_reference;
  Rigid3 cam_from_world;  ///< with the reference as in the snapshot
  /// Motion since the last frame whose pose was estimated, or that began a new part of the map, in
  /// the snapshot; predicted if the pose is. std::nullopt: unknown, because the frame begins a map.
  std::optional<Rigid3> cam_from_last;
  bool is_implausible = false;     ///< the pose follows a gap, and its motion is not plausible
  bool is_jump = false;            ///< it is implausible itself, not for following such a pose
  FrameMatches matches;            ///< inliers among the landmarks
  std::vector<PlaneMatch> planes;  ///< matched with those of the map
  /// Its dynamic matches and cells are those of the pose optimisation that found most of them.
  PoseSummary pose;
  /// Landmarks that were predicted to be visible, matched ones included; for culling.
  PerKind<std::vector<LandmarkId>> visible;
  /// Velocity at the previous frame if that became a keyframe, from the frames before and after it.
  std::optional<CameraVelocity> previous_velocity;
  KeyframeProposal keyframe;
  TrackingTimes times;
};

}  // namespace msc_vo
