// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/tracking/pose_support.h"

#include <cstddef>

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

PoseFit FitOf(const TrackedFrame& tracked, const LocalMap& candidates) {
  const double support = Support(tracked.pose);
  const FrameMatches& matches = tracked.matches;
  const bool is_clear =
      support >= kClearOfMatches * Count(matches.points.size(), matches.lines.size()) &&
      support >= kClearOfVisible * Count(candidates.points.size(), candidates.lines.size());
  return is_clear ? PoseFit::kClear : PoseFit::kPoor;
}

bool IsClearlyBetter(const PoseSummary& far, const PoseSummary& near) {
  return Support(far) > kClearlyBetter * Support(near);
}

}  // namespace msc_vo
