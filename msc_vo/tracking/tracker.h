// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>

#include "msc_vo/map/snapshot.h"
#include "msc_vo/tracking/motion_model.h"
#include "msc_vo/tracking/tracked_frame.h"
#include "msc_vo/tracking/tracker_options.h"

namespace msc_vo {

/// Estimates the pose of every frame against a snapshot of the map (paper: Tracking), and proposes
/// keyframes. Never changes the map.
class Tracker {
 public:
  /// Throws std::invalid_argument on invalid options.
  explicit Tracker(const TrackerOptions& options);

  /// Tracks the next frame. The returned frame is compensated for the rolling shutter like the map,
  /// unless the camera's velocity is unknown, as after a gap. Frames must be in order of time, and
  /// snapshots never older than those before.
  TrackedFrame Track(std::shared_ptr<const Frame> raw, const MapSnapshot& snapshot);

  /// Motion of the camera over the last tracked frames.
  const MotionModel& motion() const { return motion_; }

 private:
  // Makes the first frame a keyframe if it has enough features with depth.
  TrackedFrame Initialize(std::shared_ptr<const Frame> frame);

  // Stage 1, the initial pose: by matching with the last frame around the predicted pose, then with
  // a wide search radius, then with the reference keyframe, then by relocalisation. Each returns
  // false if it did not find a pose.
  bool TrackInitialPose(const Map& map, const Rigid3& prediction, TrackedFrame* tracked);
  bool TrackLastFrame(const Map& map, const Rigid3& prediction, double radius,
                      TrackedFrame* tracked) const;
  bool TrackReference(const Map& map, const Rigid3& prediction, TrackedFrame* tracked) const;
  bool Relocalize(const Map& map, TrackedFrame* tracked);
  // Without an initial pose: constant velocity, predicted or lost.
  void BridgeWithPrediction(const Map& map, const Rigid3& prediction, TrackedFrame* tracked) const;

  // Stage 2: matching with the local map. Returns false and keeps the initial pose if the local map
  // has too few landmarks.
  bool TrackLocalMap(const Map& map, TrackedFrame* tracked) const;
  TrackingStatus ClassifyStatus(const TrackedFrame& tracked) const;

  // Stage 3: decides whether the frame becomes a keyframe.
  void ProposeKeyframe(const MapSnapshot& snapshot, TrackedFrame* tracked);

  // Updates the motion model, and with it the velocity at the last frame.
  void UpdateMotion(const Rigid3& last_from_world, TrackedFrame* tracked);

  // Motion-only bundle adjustment of the matches. Returns false and restores the pose if the result
  // is not supported by enough inliers.
  bool EstimatePose(const PoseOptions& options, const Map& map, TrackedFrame* tracked) const;

  TrackerOptions options_;
  PoseOptions initial_pose_;  // of stage 1
  KeyframePolicy policy_;
  MotionModel motion_;
  TrackedFrame last_;                  // the last frame whose pose was estimated
  KeyframeId next_candidate_ = kNoId;  // the next keyframe to relocalise against
};

}  // namespace msc_vo
