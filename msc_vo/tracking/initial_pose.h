// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "msc_vo/tracking/frame_pose.h"
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

/// Returns the keyframes that relocalisation tries in the frame.
using KeyframeSelection = std::function<std::vector<KeyframeId>()>;

/// Finds the initial pose of a frame: by matching with the last frame around the predicted pose; if
/// few of the matches or of the visible features support it, with a wide search radius and around
/// poses that lines and points of the last frame determine without a prediction; then with the map
/// there; then by relocalisation.
std::optional<InitialPose> FindInitialPose(const TrackerOptions& options, const Frame& frame,
                                           const LastFrame& last, const PosePrediction& prediction,
                                           const KeyframeSelection& keyframes,
                                           PoseEstimator* estimator);

/// The keyframe `id`, or the newest one if it was removed from the map.
KeyframeId ReferenceOrNewest(const Map& map, KeyframeId id);

}  // namespace msc_vo
