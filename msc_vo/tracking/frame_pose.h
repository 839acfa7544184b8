// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "msc_vo/matching/local_map.h"
#include "msc_vo/pose_estimation/pose_optimization.h"
#include "msc_vo/timing/stopwatch.h"
#include "msc_vo/tracking/last_frame.h"
#include "msc_vo/tracking/tracker_options.h"

namespace msc_vo {

/// The features of the last frame as candidates for matching from `cam_from_world`: its landmarks
/// at their present position in the map, and its other features that have a depth at their measured
/// position. The latter carry the tracking where the map has few landmarks.
LocalMap CandidatesFromFrame(const Map& map, const LastFrame& last, const Rigid3& cam_from_world);

/// Matches `frame` with the candidates of `local` within `radius` pixels, in addition to the
/// `known` matches, whose landmarks and features are not matched again. Returns both.
FrameMatches MatchLocalMap(const TrackerOptions& options, const Frame& frame, const LocalMap& local,
                           double radius, const FrameMatches& known);

/// The inliers among the matches with landmarks.
FrameMatches LandmarkInliers(const FrameMatches& matches);
PerKind<int> CountLandmarkInliers(const FrameMatches& matches);

/// A pose of a frame in a map, and the matches that it was estimated from.
struct FramePose {
  Rigid3 cam_from_world;
  FrameMatches matches;
  PoseSummary summary;
};

/// Motion-only bundle adjustment of `frame` with `matches` and custom `factors`, starting from
/// *cam_from_world; marks the inliers. The sigmas of the features are multiplied by `scale` and by
/// the noise of their landmark in `map`.
PoseSummary EstimateFramePose(const PoseOptions& options, const Frame& frame, const Map& map,
                              const NoiseScale& scale, const std::vector<PoseFactor>& factors,
                              Rigid3* cam_from_world, FrameMatches* matches);

/// Number of matches for comparison with options.min_matches. Lines count twice in an image that
/// has fewer points than that: in others, a pose by a few lines and no point would be one by
/// chance.
int NumMatches(const TrackerOptions& options, const Frame& frame, const PerKind<int>& matches);

/// Whether enough of the matches are inliers of the pose: at least `min_matches`, and
/// `min_inlier_ratio` of all but the dynamic ones. If at least `min_matches` are confirmed static,
/// the ratio is that of these: the matches of a dynamic object that was not recognised are outliers
/// of the right pose.
bool HasEnoughInliers(const TrackerOptions& options, const Frame& frame, const FramePose& pose);

/// kTracked or kWeak, by the covariance of an estimated pose.
TrackingStatus ClassifyStatus(const TrackerOptions& options, const PoseSummary& pose);

/// Estimates poses of one frame in a map, from different matches but with the same noise and custom
/// factors. Measures its times.
class PoseEstimator {
 public:
  /// The arguments must outlive the object.
  PoseEstimator(const TrackerOptions& options, const Map& map, const NoiseScale& noise_scale,
                std::vector<PoseFactor> factors)
      : options_(options), map_(map), noise_scale_(noise_scale), factors_(std::move(factors)) {}

  /// Adds custom factors to those of the next estimates.
  void AddFactors(const std::vector<PoseFactor>& factors) {
    factors_.insert(factors_.end(), factors.begin(), factors.end());
  }

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
  std::vector<PoseFactor> factors_;
  TrackingTimes times_;
};

}  // namespace msc_vo
