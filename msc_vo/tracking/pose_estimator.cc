// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/tracking/pose_estimator.h"

namespace msc_vo {

std::optional<FramePose> PoseEstimator::Estimate(const PoseOptions& options, const Frame& frame,
                                                 const Rigid3& start, const FrameMatches& matches) {
  if (NumMatches(options_, frame, matches.points.size(), matches.lines.size()) <
      options_.min_matches) {
    return std::nullopt;
  }
  FramePose pose{start, matches, {}};
  pose.summary = Timed(&times_.pose, [&] {
    return EstimateFramePose(options, frame, map_, noise_scale_, factors_, &pose.cam_from_world,
                             &pose.matches);
  });
  return HasEnoughInliers(options_, frame, pose) ? std::make_optional(pose) : std::nullopt;
}

std::optional<FramePose> PoseEstimator::MatchAndEstimate(const PoseOptions& options,
                                                         const Frame& frame,
                                                         const LocalMap& candidates, double radius,
                                                         const Rigid3& start,
                                                         const FrameMatches& known) {
  const FrameMatches matches =
      Search([&] { return MatchLocalMap(options_, frame, candidates, radius, known); });
  return Estimate(options, frame, start, matches);
}

}  // namespace msc_vo
