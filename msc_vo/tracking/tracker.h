// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "msc_vo/map/snapshot.h"
#include "msc_vo/tracking/inactive_map_search.h"
#include "msc_vo/tracking/motion_model.h"
#include "msc_vo/tracking/pose_factor_callback.h"
#include "msc_vo/tracking/pose_plausibility.h"
#include "msc_vo/tracking/pose_support.h"
#include "msc_vo/tracking/search_budget.h"
#include "msc_vo/tracking/segment_start.h"
#include "msc_vo/tracking/tracked_frame.h"
#include "msc_vo/tracking/tracker_options.h"

namespace msc_vo {

/// Estimates the pose of every frame against a snapshot of the map (paper: Tracking), and proposes
/// keyframes and new segments. Never changes the map.
class Tracker {
 public:
  /// Throws std::invalid_argument on invalid options.
  explicit Tracker(const TrackerOptions& options);

  /// Sets the source of custom factors over the pose of every frame. They take part in every
  /// estimate of that pose. If they determine it alone, they replace constant velocity: the search
  /// for matches starts from their pose, and a frame whose image yields none keeps it.
  void SetPoseFactors(PoseFactorCallback callback) { pose_factor_callback_ = std::move(callback); }
  /// Whether the last frame had any.
  bool had_pose_factors() const { return !pose_factors_.empty(); }

  /// Tracks the next frame. The returned frame is compensated for the rolling shutter like the map,
  /// unless the camera's velocity is unknown, as after a gap. Frames must be in order of time, and
  /// snapshots never older than those before. Throws what the callback of the pose factors throws,
  /// and std::invalid_argument, naming the factor, on invalid ones (OptimizePose); the frame is
  /// then as if it had not been passed.
  TrackedFrame Track(std::shared_ptr<const Frame> raw, const MapSnapshot& snapshot);

  /// Motion of the camera over the last tracked frames.
  const MotionModel& motion() const { return motion_; }

  /// Lists the state for a checkpoint.
  template <typename Archive>
  void Serialize(Archive& archive) {
    auto& [options, initial_pose, policy, motion_model, callback, factors, last, next_candidate,
           segment_start, inactive_map_search, plausibility, in_gap] =
        *this;  // all members, or it does not compile
    archive(policy, motion_model, last, next_candidate, segment_start, inactive_map_search,
            plausibility, in_gap);
  }

 private:
  // Makes the first frame a keyframe if it has enough features with depth.
  TrackedFrame Initialize(std::shared_ptr<const Frame> frame);
  // Makes the frame the first one of a new segment, whose map the mapper begins.
  TrackedFrame BeginSegment(std::shared_ptr<const Frame> frame, const Rigid3& last_from_world);
  void StartSegment(SegmentStart start, TrackedFrame* tracked);
  // Keyframes of the map that relocalisation tries in a frame.
  int NumKeyframesToTry(const Map& map, double timestamp) const {
    return KeyframesToTry(options_.relocalization_keyframes, SecondsSincePrevious(timestamp),
                          map.keyframes().size());
  }
  // Time since the frame before, which may be one without a pose.
  double SecondsSincePrevious(double timestamp) const {
    return timestamp - segment_start_.last_timestamp();
  }
  // Whether the map is given up, because it could not be found for too long.
  bool IsNewSegmentDue(const Map& map, const TrackedFrame& tracked);

  // The pose that the matches are searched around: that of the pose factors if they determine it
  // alone (`by_factors` is usable), otherwise that of constant velocity.
  struct Prediction {
    Rigid3 cam_from_world;
    PoseSummary by_factors;
  };
  // Asks for the pose factors of the frame and predicts its pose.
  Prediction Predict(const Map& map, const Rigid3& last_from_world, const TrackedFrame& tracked);

  // Stage 1, the initial pose: by matching with the last frame around the predicted pose; if few
  // of the matches or of the visible features support it, with a wide search radius and around
  // poses that lines and points of the last frame determine without a prediction; then with the map
  // there, then by relocalisation. Each returns false if it did not find a pose.
  bool TrackInitialPose(const Map& map, const Prediction& prediction, TrackedFrame* tracked);
  PoseFit TrackLastFrame(const Map& map, const Rigid3& prediction, double radius,
                         TrackedFrame* tracked) const;
  bool TrackLargeMotion(const Map& map, const Rigid3& prediction, TrackedFrame* tracked) const;
  bool TrackMapAround(const Map& map, const Prediction& prediction, TrackedFrame* tracked) const;
  bool Relocalize(const Map& map, TrackedFrame* tracked);
  // Without an initial pose: predicted or lost.
  void BridgeWithPrediction(const Map& map, const Prediction& prediction,
                            TrackedFrame* tracked) const;
  // Whether the pose factors have moved the camera to where the map has too few landmarks, and the
  // image has enough features to begin another part of it.
  bool IsOutsideMappedArea(const Map& map, const TrackedFrame& tracked) const;

  // Stage 2: matching with the local map. Returns false and keeps the initial pose if the local map
  // has too few landmarks.
  bool TrackLocalMap(const Map& map, TrackedFrame* tracked) const;

  // Reports the motion since the last frame with a pose; expects the status of `tracked`. Returns
  // false if this pose, or one of the last five seconds, follows a gap, and is weak, takes an
  // implausible motion, or contradicts the depth images.
  bool UpdatePlausibility(const Map& map, const TrackedFrame& tracked,
                          const Rigid3& last_from_world, const Prediction& prediction);

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
  PoseFactorCallback pose_factor_callback_;  // may be empty
  std::vector<PoseFactor> pose_factors_;     // of the frame that is being tracked
  // The last frame whose pose was estimated, or that began a new part of the map.
  TrackedFrame last_;
  KeyframeId next_candidate_ = kNoId;  // the next keyframe to relocalise against
  SegmentStartPolicy segment_start_;
  InactiveMapSearch inactive_map_search_;
  PosePlausibility plausibility_;
  bool in_gap_ = false;  // frames since `last_` have no pose
};

}  // namespace msc_vo
