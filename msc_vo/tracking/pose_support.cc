// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/tracking/pose_support.h"

#include <algorithm>

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

}  // namespace

double Support(const PoseSummary& pose) { return Support(pose.num_inliers); }

bool IsClear(const FramePose& pose, const LocalMap& candidates) {
  const double support = Support(pose.summary);
  // Matches on dynamic objects neither support a pose nor contradict it.
  const double dynamic = pose.summary.num_dynamic;
  const double matched = Support(SizesOf(pose.matches)) - dynamic;
  const double visible = Support(SizesOf(candidates)) - dynamic;
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

int NumMatchable(const Frame& frame, const MatchCounts& place, const MatchCounts& other) {
  int num_matchable = 0;
  ForEachLandmarkKind([&](auto kind) {
    using L = typename decltype(kind)::Landmark;
    const int num_features = static_cast<int>(FeaturesOf<L>(frame).size());
    num_matchable += std::min(place.in_view.Of<L>(), std::max(num_features, other.in_view.Of<L>()));
  });
  return num_matchable;
}

bool HasComparableMatchRatio(const Frame& frame, const MatchCounts& place,
                             const MatchCounts& other) {
  constexpr double kMinRelativeRatio = 0.5;
  return static_cast<double>(place.num_matched) * Sum(other.in_view) >=
         kMinRelativeRatio * other.num_matched * NumMatchable(frame, place, other);
}

bool ContradictsDepth(const TrackedFrame& tracked, const Map& map) {
  const Keyframe* reference = map.FindKeyframe(tracked.reference);
  if (reference == nullptr) return false;
  const int num_violations =
      NumFreeSpaceViolations(*reference->frame, *tracked.frame, tracked.cam_from_reference);
  return num_violations > Support(tracked.pose);
}

}  // namespace msc_vo
