// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>

#include "msc_vo/tracking/pose_estimator.h"
#include "msc_vo/tracking/pose_plausibility.h"

namespace msc_vo {

/// The pose that the matches of a frame are searched around: that of the custom factors if they
/// determine it alone (`by_factors` is usable), otherwise that of constant velocity.
struct PosePrediction {
  Rigid3 cam_from_world;
  PoseSummary by_factors;
};

/// The pose of a frame that its local map is selected with. By relocalisation: kAfterGap.
struct InitialPose {
  FramePose pose;
  PoseOrigin origin = PoseOrigin::kPrediction;
};

/// Searches the initial poses of frames.
class InitialPoseSearch {
 public:
  explicit InitialPoseSearch(const TrackerOptions& options);

  /// Searches the pose of a frame: by matching with the last frame around the predicted pose; if
  /// few of the matches or of the visible features support it, with a wide search radius and around
  /// poses that lines and points of the last frame determine without a prediction; then with the
  /// map there; then by relocalisation against the next `num_keyframes` keyframes.
  std::optional<InitialPose> Find(const Frame& frame, const LastFrame& last,
                                  const PosePrediction& prediction, int num_keyframes,
                                  PoseEstimator* estimator);
  /// Relocalises against the newest keyframe next.
  void Restart() { next_keyframe_ = kNoId; }

  /// Lists the state for a checkpoint.
  template <typename Archive>
  void Serialize(Archive& archive) {
    auto& [options, pose_options, next_keyframe] = *this;  // all members, or it does not compile
    archive(next_keyframe);
  }

 private:
  // A pose near a given one, and whether it is clear (IsClear).
  struct NearPose {
    FramePose pose;
    bool is_clear = false;
  };
  std::optional<NearPose> MatchLastFrame(const Frame& frame, const LastFrame& last,
                                         const Rigid3& near, double radius,
                                         PoseEstimator* estimator) const;
  std::optional<FramePose> FindLargeMotion(const Frame& frame, const LastFrame& last,
                                           const Rigid3& prediction,
                                           PoseEstimator* estimator) const;
  std::optional<FramePose> MatchMap(const Frame& frame, const LastFrame& last,
                                    const PosePrediction& prediction,
                                    PoseEstimator* estimator) const;
  std::optional<FramePose> Relocalize(const Frame& frame, int num_keyframes,
                                      PoseEstimator* estimator);

  TrackerOptions options_;
  PoseOptions pose_options_;
  KeyframeId next_keyframe_ = kNoId;  // to relocalise against; kNoId: the newest
};

/// The keyframe `id`, or the newest one if it was removed from the map.
KeyframeId ReferenceOrNewest(const Map& map, KeyframeId id);

}  // namespace msc_vo
