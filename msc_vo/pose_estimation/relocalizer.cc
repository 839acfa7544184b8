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
