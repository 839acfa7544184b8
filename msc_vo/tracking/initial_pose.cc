// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/tracking/initial_pose.h"

#include <algorithm>
#include <vector>

#include "msc_vo/pose_estimation/relocalizer.h"
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

// A pose by matching with the last frame, and whether it is clear (IsClear).
struct NearPose {
  FramePose pose;
  bool is_clear = false;
};

// The search for the initial pose of one frame.
class InitialPoseSearch {
 public:
  InitialPoseSearch(const TrackerOptions& options, const Frame& frame, const LastFrame& last,
                    const PosePrediction& prediction, PoseEstimator* estimator)
      : options_(options),
        pose_options_(InitialPoseOptions(options.pose)),
        frame_(frame),
        last_(last),
        prediction_(prediction),
        map_(estimator->map()),
        estimator_(*estimator) {}

  std::optional<NearPose> MatchLastFrame(const Rigid3& near, double radius) {
    const LocalMap candidates =
        estimator_.Search([&] { return CandidatesFromFrame(map_, last_, near); });
    const std::optional<FramePose> pose =
        estimator_.MatchAndEstimate(pose_options_, frame_, candidates, radius, near);
    if (!pose) return std::nullopt;
    return NearPose{*pose, IsClear(*pose, candidates)};
  }

  // The best of the poses by a wide search and by searches without a prediction.
  std::optional<FramePose> FindLargeMotion() {
    const std::vector<Relocalization> poses = estimator_.Search([&] {
      return FindPoses(options_.relocalizer, options_.matchers.line_matcher, frame_,
                       CandidatesFromFrame(map_, last_, last_.CamFromWorld(map_)), kMaxSearchPoses);
    });
    std::optional<FramePose> best;
    const auto try_pose = [&](const Rigid3& pose, double radius) {
      const std::optional<NearPose> found = MatchLastFrame(pose, radius);
      if (!found) return;
      if (!best || Support(found->pose.summary) > Support(best->summary)) best = found->pose;
    };
    try_pose(prediction_.cam_from_world, options_.wide_radius);
    for (const Relocalization& pose : poses) {
      try_pose(pose.cam_from_world, options_.prediction_radius);
    }
    return best;
  }

  // With the map around the pose of the custom factors, or else the neighbourhood of the reference
  // keyframe.
  std::optional<FramePose> MatchMap() {
    const Rigid3& pose = prediction_.cam_from_world;
    const LocalMap local = estimator_.Search([&] {
      return prediction_.by_factors.usable
                 ? SelectVisibleLandmarks(map_, frame_, pose)
                 : SelectLocalMap(map_, frame_, pose, {}, ReferenceOrNewest(map_, last_.reference),
                                  options_.max_local_keyframes);
    });
    return estimator_.MatchAndEstimate(pose_options_, frame_, local, options_.wide_radius, pose);
  }

  std::optional<FramePose> Relocalize(const KeyframeSelection& keyframes) {
    for (const KeyframeId id : estimator_.Search(keyframes)) {
      const std::optional<Relocalization> hit = estimator_.Search([&] {
        return msc_vo::Relocalize(options_.relocalizer, options_.matchers.line_matcher, frame_,
                                  map_, *map_.FindKeyframe(id));
      });
      if (!hit) continue;
      const std::optional<FramePose> pose =
          estimator_.Estimate(pose_options_, frame_, hit->cam_from_world, hit->matches);
      if (pose) return pose;
    }
    return std::nullopt;
  }

 private:
  const TrackerOptions& options_;
  const PoseOptions pose_options_;
  const Frame& frame_;
  const LastFrame& last_;
  const PosePrediction& prediction_;
  const Map& map_;
  PoseEstimator& estimator_;
};

}  // namespace

KeyframeId ReferenceOrNewest(const Map& map, KeyframeId id) {
  return map.FindKeyframe(id) != nullptr ? id : map.keyframes().back().first;
}

std::optional<InitialPose> FindInitialPose(const TrackerOptions& options, const Frame& frame,
                                           const LastFrame& last, const PosePrediction& prediction,
                                           const KeyframeSelection& keyframes,
                                           PoseEstimator* estimator) {
  InitialPoseSearch search(options, frame, last, prediction, estimator);
  const std::optional<NearPose> near =
      search.MatchLastFrame(prediction.cam_from_world, options.prediction_radius);
  if (near && near->is_clear) return InitialPose{near->pose, PoseOrigin::kPrediction};
  const std::optional<FramePose> far = search.FindLargeMotion();
  if (far && (!near || IsClearlyBetter(options, far->summary, near->pose.summary))) {
    return InitialPose{*far, PoseOrigin::kSearch};
  }
  if (near) return InitialPose{near->pose, PoseOrigin::kPrediction};
  if (const auto pose = search.MatchMap()) return InitialPose{*pose, PoseOrigin::kPrediction};
  const std::optional<FramePose> pose = search.Relocalize(keyframes);
  if (!pose) return std::nullopt;
  return InitialPose{*pose, PoseOrigin::kAfterGap};
}

}  // namespace msc_vo
