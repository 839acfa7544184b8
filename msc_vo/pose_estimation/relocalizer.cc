// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/pose_estimation/relocalizer.h"

#include <vector>

#include "msc_vo/matching/local_map.h"
#include "msc_vo/pose_estimation/pose_search.h"

namespace msc_vo {

namespace {

// Score of the second best pose, relative to the best, above which neither is believed.
constexpr double kMaxRival = 0.8;

}  // namespace

bool RelocalizerOptions::IsValid(std::string* error) const {
  if (max_distance < 0 || max_distance > 256) {
    *error = "relocalizer: max_distance must be between 0 and 256 bits";
  } else if (!(max_ratio > 0.0 && max_ratio <= 1.0)) {
    *error = "relocalizer: max_ratio must be in (0, 1]";
  } else if (max_iterations < 1 || min_inliers < 3) {
    *error = "relocalizer: max_iterations >= 1 and min_inliers >= 3 must hold";
  } else if (!(max_angle > 0.0 && max_angle <= 45.0)) {
    *error = "relocalizer: max_angle must be in (0, 45] degrees";
  } else {
    return true;
  }
  return false;
}

std::optional<Relocalization> Relocalize(const RelocalizerOptions& options,
                                         const LineMatcherOptions& line_matcher, const Frame& frame,
                                         const Map& map, const Keyframe& keyframe) {
  const std::vector<Relocalization> poses =
      FindPoses(options, line_matcher, frame, LandmarksOf(map, keyframe), 2);
  if (poses.empty()) return std::nullopt;
  if (poses.size() > 1 && poses[1].score > kMaxRival * poses[0].score) return std::nullopt;
  return poses.front();
}

}  // namespace msc_vo
