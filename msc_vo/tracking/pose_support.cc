// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/tracking/pose_support.h"

#include <algorithm>
#include <cstddef>

#include "msc_vo/map/free_space.h"

namespace msc_vo {

namespace {

// Fractions of the matches, and of the features that should be visible, that support a pose which
// needs no search for a better one. A pose by chance, among matches of noise or among parallel
// lines with similar descriptors, has less. Chosen by measurement, see docs/lab/large_steps.md.
constexpr double kClearOfMatches = 0.5;
constexpr double kClearOfVisible = 0.25;
// More than what two estimates of one pose differ by.
constexpr double kClearlyBetter = 1.5;

double Count(size_t num_points, size_t num_lines) {
  return static_cast<double>(num_points + kPointsPerLine * num_lines);
}

}  // namespace

double Support(const PoseSummary& pose) {
  return pose.num_inlier_points + kPointsPerLine * pose.num_inlier_lines;
}

bool IsClear(const FramePose& pose, const LocalMap& candidates) {
  const double support = Support(pose.summary);
  // Matches on dynamic objects neither support a pose nor contradict it.
  const double dynamic = pose.summary.num_dynamic;
  const double matched = Count(pose.matches.points.size(), pose.matches.lines.size()) - dynamic;
  const double visible = Count(candidates.points.size(), candidates.lines.size()) - dynamic;
  return support >= kClearOfMatches * matched && support >= kClearOfVisible * visible;
}

bool IsClearlyBetter(const TrackerOptions& options, const PoseSummary& far,
                     const PoseSummary& near) {
  const int most_confirmed = std::max(far.num_confirmed_inliers, near.num_confirmed_inliers);
  if (most_confirmed >= options.min_matches) {
    return far.num_confirmed_inliers > kClearlyBetter * near.num_confirmed_inliers;
  }
  // A near, textured object supports the pose that moves with it.
  return Support(far) > kClearlyBetter * (Support(near) + near.num_dynamic);
}

bool HasComparableMatchRatio(const FrameMatches& found, const LocalMap& place,
                             const TrackedFrame& tracked) {
  constexpr double kMinRelativeRatio = 0.5;  // the direction of view may be another
  const auto num_features = [](const FrameMatches& matches) {
    return static_cast<double>(matches.points.size() + matches.lines.size());
  };
  const auto in_view = static_cast<double>(place.points.size() + place.lines.size());
  const auto in_view_now =
      static_cast<double>(tracked.visible.points.size() + tracked.visible.lines.size());
  return num_features(found) * in_view_now >=
         kMinRelativeRatio * num_features(tracked.matches) * in_view;
}

bool ContradictsDepth(const TrackedFrame& tracked, const Map& map) {
  const Keyframe* reference = map.FindKeyframe(tracked.reference);
  if (reference == nullptr) return false;
  const int num_violations =
      NumFreeSpaceViolations(*reference->frame, *tracked.frame, tracked.cam_from_reference);
  return num_violations > Support(tracked.pose);
}

}  // namespace msc_vo
