// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/evaluation/segment_error.h"

#include <algorithm>
#include <map>

namespace msc_vo {

std::vector<SegmentError> EvaluateSegments(const std::vector<TimedPose>& reference,
                                           const std::vector<TimedPose>& estimate,
                                           const EvaluationOptions& options) {
  std::map<int, std::vector<TimedPose>> segments;
  for (const TimedPose& pose : estimate) segments[pose.segment].push_back(pose);
  std::vector<SegmentError> errors;
  if (segments.size() < 2) return errors;
  for (const auto& [segment, poses] : segments) {
    errors.push_back({segment, poses.front().world, EvaluateTrajectory(reference, poses, options)});
  }
  return errors;
}

bool HasSeveralWorlds(const std::vector<TimedPose>& poses) {
  return std::any_of(poses.begin(), poses.end(),
                     [&poses](const TimedPose& pose) { return pose.world != poses.front().world; });
}

}  // namespace msc_vo
