// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/tracking/initial_pose.h"

#include <algorithm>
#include <vector>

#include "msc_vo/pose_estimation/pose_search.h"
#include "msc_vo/tracking/pose_support.h"

namespace msc_vo {

namespace {

// Poses of a search without a prediction that are tried.
constexpr int kMaxSearchPoses = 5;

// The pose is optimised again with the local map, so that the robust rounds suffice here.
PoseOptions InitialPoseOptions(PoseOptions options) {
  options.num_rounds = std::max(1, options.num_robust_rounds);
  return options;
}

}  // namespace

KeyframeId ReferenceOrNewest(const Map& map, KeyframeId id) {
  return map.FindKeyframe(id) != nullptr ? id : map.keyframes().back().first;
}

InitialPoseSearch::InitialPoseSearch(const TrackerOptions& options)
    : options_(options), pose_options_(InitialPoseOptions(options.pose)) {}

std::optional<InitialPose> InitialPoseSearch::Find(const Frame& frame, const LastFrame& last,
                                                   const PosePrediction& prediction,
                                                   int num_keyframes, PoseEstimator* estimator) {
  const Rigid3& predicted = prediction.cam_from_world;
  const std::optional<NearPose> near =
      MatchLastFrame(frame, last, predicted, options_.prediction_radius, estimator);
  if (near && near->is_clear) return InitialPose{near->pose, PoseOrigin::kPrediction};
  const std::optional<FramePose> far = FindLargeMotion(frame, last, predicted, estimator);
  if (far && (!near || IsClearlyBetter(options_, far->summary, near->pose.summary))) {
    return InitialPose{*far, PoseOrigin::kSearch};
  }
  if (near) return InitialPose{near->pose, PoseOrigin::kPrediction};
  if (const auto pose = MatchMap(frame, last, prediction, estimator)) {
    return InitialPose{*pose, PoseOrigin::kPrediction};
  }
  if (const auto pose = Relocalize(frame, num_keyframes, estimator)) {
    return InitialPose{*pose, PoseOrigin::kAfterGap};
  }
  return std::nullopt;
}

std::optional<InitialPoseSearch::NearPose> InitialPoseSearch::MatchLastFrame(
    const Frame& frame, const LastFrame& last, const Rigid3& near, double radius,
    PoseEstimator* estimator) const {
  const LocalMap candidates =
      estimator->Search([&] { return CandidatesFromFrame(estimator->map(), last, near); });
  const std::optional<FramePose> pose =
      estimator->MatchAndEstimate(pose_options_, frame, candidates, radius, near);
  if (!pose) return std::nullopt;
  return NearPose{*pose, IsClear(*pose, candidates)};
}

std::optional<FramePose> InitialPoseSearch::FindLargeMotion(const Frame& frame,
                                                            const LastFrame& last,
                                                            const Rigid3& prediction,
                                                            PoseEstimator* estimator) const {
  const std::vector<Relocalization> poses = estimator->Search([&] {
    const Map& map = estimator->map();
    return FindPoses(options_.relocalizer, options_.line_matcher, frame,
                     CandidatesFromFrame(map, last, last.CamFromWorld(map)), kMaxSearchPoses);
  });
  std::optional<FramePose> best;
  const auto try_pose = [&](const Rigid3& pose, double radius) {
    const std::optional<NearPose> found = MatchLastFrame(frame, last, pose, radius, estimator);
    if (!found) return;
    if (!best || Support(found->pose.summary) > Support(best->summary)) best = found->pose;
  };
  try_pose(prediction, options_.wide_radius);
  for (const Relocalization& pose : poses) {
    try_pose(pose.cam_from_world, options_.prediction_radius);
  }
  return best;
}

// The map around the pose of the pose factors, or else the neighbourhood of the reference keyframe.
std::optional<FramePose> InitialPoseSearch::MatchMap(const Frame& frame, const LastFrame& last,
                                                     const PosePrediction& prediction,
                                                     PoseEstimator* estimator) const {
  const Rigid3& pose = prediction.cam_from_world;
  const LocalMap local = estimator->Search([&] {
    const Map& map = estimator->map();
    return prediction.by_factors.usable
               ? SelectVisibleLandmarks(map, frame, pose)
               : SelectLocalMap(map, frame, pose, {}, ReferenceOrNewest(map, last.reference),
                                options_.max_local_keyframes);
  });
  return estimator->MatchAndEstimate(pose_options_, frame, local, options_.wide_radius, pose);
}

// From newest to oldest, a few keyframes per frame, cyclically.
std::optional<FramePose> InitialPoseSearch::Relocalize(const Frame& frame, int num_keyframes,
                                                       PoseEstimator* estimator) {
  const Map& map = estimator->map();
  for (int i = 0; i < num_keyframes; ++i) {
    const auto* keyframe = map.keyframes().FindUpTo(next_keyframe_);
    if (keyframe == nullptr) keyframe = &map.keyframes().back();
    next_keyframe_ = keyframe->first - 1;
    const std::optional<Relocalization> hit = estimator->Search([&] {
      return msc_vo::Relocalize(options_.relocalizer, options_.line_matcher, frame, map,
                                keyframe->second);
    });
    if (!hit) continue;
    if (const auto pose =
            estimator->Estimate(pose_options_, frame, hit->cam_from_world, hit->matches)) {
      Restart();
      return pose;
    }
  }
  return std::nullopt;
}

}  // namespace msc_vo
