// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>
#include <vector>

#include "msc_vo/timing/stopwatch.h"
#include "msc_vo/tracking/frame_pose.h"

namespace msc_vo {

/// Estimates poses of one frame in a map, from different matches but with the same noise and custom
/// factors. Measures its times.
class PoseEstimator {
 public:
  /// The arguments must outlive the object.
  PoseEstimator(const TrackerOptions& options, const Map& map, const NoiseScale& noise_scale,
                const std::vector<PoseFactor>& factors)
      : options_(options), map_(map), noise_scale_(noise_scale), factors_(factors) {}

  const Map& map() const { return map_; }

  /// The pose by `matches`, from `start`; std::nullopt if too few of them support it.
  std::optional<FramePose> Estimate(const PoseOptions& options, const Frame& frame,
                                    const Rigid3& start, const FrameMatches& matches);
  /// The same with the matches of the frame and the candidates within `radius` pixels, and `known`
  /// ones (MatchLocalMap).
  std::optional<FramePose> MatchAndEstimate(const PoseOptions& options, const Frame& frame,
                                            const LocalMap& candidates, double radius,
                                            const Rigid3& start, const FrameMatches& known = {});

  /// Runs a search for candidates or matches, whose time is part of that of matching.
  template <typename Step>
  auto Search(const Step& step) {
    return Timed(&times_.matching, step);
  }
  const TrackingTimes& times() const { return times_; }

 private:
  const TrackerOptions& options_;
  const Map& map_;
  const NoiseScale& noise_scale_;
  const std::vector<PoseFactor>& factors_;
  TrackingTimes times_;
};

}  // namespace msc_vo
