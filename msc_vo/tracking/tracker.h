// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "msc_vo/map/snapshot.h"
#include "msc_vo/tracking/initial_pose.h"
#include "msc_vo/tracking/keyframe_policy.h"
#include "msc_vo/tracking/motion_model.h"
#include "msc_vo/tracking/place_search.h"
#include "msc_vo/tracking/plane_pose.h"
#include "msc_vo/tracking/pose_factor_callback.h"
#include "msc_vo/tracking/pose_plausibility.h"
#include "msc_vo/tracking/segment_start.h"
#include "msc_vo/tracking/tracked_frame.h"
#include "msc_vo/tracking/tracker_options.h"

namespace msc_vo {

/// Estimates the pose of every frame against a snapshot of the map (paper: Tracking), and proposes
/// keyframes and new segments. Never changes the map.
class Tracker {
 public:
  /// The options must be valid (OdometryOptions::IsValid).
  explicit Tracker(const TrackerOptions& options);

  /// Sets the source of custom factors over the pose of every frame. They take part in every
  /// estimate of that pose. If they determine it alone, they replace constant velocity: the search
  /// for matches starts from their pose, and a frame whose image yields none keeps it.
  void SetPoseFactors(PoseFactorCallback callback) { pose_factor_callback_ = std::move(callback); }

  /// Sets the id of the first keyframe. Call it before the first frame.
  void SetFirstKeyframe(KeyframeId id) { next_keyframe_ = id; }

  /// Tracks the next frame, which is as the features were extracted. The returned one is
  /// compensated for the rolling shutter like the map, unless the camera's velocity is unknown, as
  /// after a gap. Frames must be in order of time, and snapshots never older than those before.
  /// Throws what the callback of the pose factors and their cost functions throw, and
  /// std::invalid_argument, naming the factor, on invalid ones (OptimizePose); the frame is then as
  /// if it had not been passed.
  TrackedFrame Track(const std::shared_ptr<const Frame>& raw, const MapSnapshot& snapshot);

  /// The same without custom factors over the pose.
  TrackedFrame TrackWithoutFactors(const std::shared_ptr<const Frame>& raw,
                                   const MapSnapshot& snapshot) {
    return TrackFrame(raw, snapshot, false);
  }

  /// Motion of the camera over the last tracked frames.
  const MotionModel& motion() const { return motion_; }

  /// Lists the state for a checkpoint.
  template <typename Archive>
  void Serialize(Archive& archive) {
    auto& [options, policy, motion_model, callback, factors, last, next_keyframe, places,
           relocalization, segment_start, plausibility, in_gap, last_determined, last_covariance] =
        *this;  // all members, or it does not compile
    archive(policy, motion_model, last, next_keyframe, places, relocalization, segment_start,
            plausibility, in_gap, last_determined, last_covariance);
  }

 private:
  // The directions of the planes that give a pose.
  enum class PlanesSpan { kAny, kSpace };
  // A frame and what is known about it before it is matched.
  struct Input {
    const MapSnapshot& snapshot;
    std::shared_ptr<const Frame> raw;    // as extracted
    std::shared_ptr<const Frame> frame;  // compensated with the predicted velocity
    Rigid3 last_from_world;              // pose of `last_` in the map
    PosePrediction prediction;
  };

  // Makes the first frame a keyframe if it has enough features with depth.
  TrackedFrame Initialize(const std::shared_ptr<const Frame>& frame);
  // Makes the frame the first one of a new segment, whose map the mapper begins.
  TrackedFrame BeginSegment(const Input& input);
  void StartSegment(SegmentStart start, TrackedFrame* tracked);

  TrackedFrame TrackFrame(const std::shared_ptr<const Frame>& raw, const MapSnapshot& snapshot,
                          bool use_factors);
  // Updates the last frame to the map, predicts the pose and asks for the pose factors.
  Input Predict(const std::shared_ptr<const Frame>& raw, const MapSnapshot& snapshot,
                bool use_factors);
  // Without an initial pose: bridges the frame, unless it begins a new segment, or a new part of
  // the map, where pose factors have moved the camera.
  TrackedFrame TrackInGap(const Input& input);
  // Without an initial pose in the map: by the planes and the pose factors; std::nullopt if the
  // frame does not follow one with a pose, or its matched planes do not span the directions.
  std::optional<TrackedFrame> TrackByPlanes(const Input& input, PlanesSpan span);
  // Holds a pose by planes, which leave directions free, by landmarks as well.
  void HoldByLandmarks(const Input& input, PlanePose* pose, TrackedFrame* tracked) const;
  // The frame as the velocity compensates it that a pose yields.
  std::shared_ptr<const Frame> CompensateAgain(const Input& input,
                                               const Rigid3& cam_from_world) const;
  // The pose that the last frame and the pose factors predict.
  ExpectedPose ExpectPoseOf(const Input& input) const;
  // The frame with the predicted pose, predicted or lost.
  TrackedFrame BridgeWithPrediction(const Input& input) const;
  // Whether the map is given up, because it could not be found for too long.
  bool IsNewSegmentDue(const Map& map, const TrackedFrame& tracked);
  // Whether the pose factors have moved the camera to where the map has too few landmarks, and the
  // image has enough features to begin another part of it.
  bool IsOutsideMappedArea(const Map& map, const TrackedFrame& tracked) const;

  // From the initial pose on: pose in the local map, status, and whether it becomes a keyframe.
  TrackedFrame TrackInMap(const Input& input, const InitialPose& initial, PoseEstimator* estimator);
  // Matches the frame with the local map around its initial pose, which remains, as kWeak, if that
  // has too few landmarks. `is_in_map`: IsInMap().
  TrackedFrame TrackLocalMap(const Input& input, const FramePose& initial, bool is_in_map,
                             PoseEstimator* estimator) const;
  // Whether landmarks or custom factors determine an initial pose. If not, it is relative to the
  // last frame, by features of that.
  bool IsInMap(const Input& input, const FramePose& initial) const;
  // The initial pose as a prior; one relative to the last frame has the error of that, too.
  PlanePosePrior PriorOf(const Input& input, const FramePose& initial, bool is_in_map) const;
  // Makes a tracked frame kWeak and implausible if its pose, or one of the last five seconds,
  // follows a gap, and is weak, takes an implausible motion, or contradicts the depth images.
  void ConfirmStatus(const Input& input, PoseOrigin origin, TrackedFrame* tracked);
  // Adds the covariance of the jump to that of an implausible pose, not to `last_covariance_`.
  void AddJumpCovariance(const Input& input, TrackedFrame* tracked);
  // Decides whether the frame becomes a keyframe.
  KeyframeProposal ProposeKeyframe(const Input& input, const TrackedFrame& tracked,
                                   PoseEstimator* estimator);
  // Decides the id of the keyframe that a frame becomes.
  KeyframeId MakeKeyframe(double timestamp);
  // Updates the motion model, and with it the velocity at the last frame, which is replaced.
  void Follow(TrackedFrame* tracked);

  // Keyframes of the map that relocalisation tries in a frame.
  int NumKeyframesToTry(const Map& map, double timestamp) const {
    return KeyframesToTry(options_.relocalization_keyframes, SecondsSincePrevious(timestamp),
                          map.keyframes().size());
  }
  // Time since the frame before, which may be one without a pose.
  double SecondsSincePrevious(double timestamp) const {
    return timestamp - segment_start_.last_timestamp();
  }

  TrackerOptions options_;
  KeyframePolicy policy_;
  MotionModel motion_;
  PoseFactorCallback pose_factor_callback_;  // may be empty
  std::vector<PoseFactor> pose_factors_;     // of the frame that is being tracked
  LastFrame last_;
  KeyframeId next_keyframe_ = 0;  // the id of the next keyframe
  PlaceSearch places_;
  TryOrder relocalization_;  // since the last frame that was found
  SegmentStartPolicy segment_start_;
  PosePlausibility plausibility_;
  bool in_gap_ = false;           // frames since `last_` have no pose
  double last_determined_ = 0.0;  // time of the last frame whose pose was certain, seconds
  PoseCovariance last_covariance_ = PoseCovariance::Zero();  // of the camera of `last_`
};

}  // namespace msc_vo
