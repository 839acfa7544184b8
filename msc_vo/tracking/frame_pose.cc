// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/tracking/frame_pose.h"

#include <algorithm>
#include <cmath>

#include "msc_vo/geometry/angles.h"

namespace msc_vo {

namespace {

// Candidates whose landmark is not among the known matches.
template <typename C, typename M>
std::vector<C> Unmatched(const std::vector<C>& candidates, const std::vector<M>& known) {
  std::vector<LandmarkId> matched;
  matched.reserve(known.size());
  for (const M& match : known) matched.push_back(match.id);
  std::sort(matched.begin(), matched.end());
  std::vector<C> unmatched;
  unmatched.reserve(candidates.size());
  for (const C& candidate : candidates) {
    const bool is_matched =
        candidate.id != kNoId && std::binary_search(matched.begin(), matched.end(), candidate.id);
    if (!is_matched) unmatched.push_back(candidate);
  }
  return unmatched;
}

template <typename M>
std::vector<bool> TakenFeatures(const std::vector<M>& matches, size_t num_features) {
  std::vector<bool> taken(num_features, false);
  for (const M& match : matches) taken[match.feature] = true;
  return taken;
}

// Whether a landmark is confirmed static: two keyframes observed it at the same position.
template <typename L>
bool IsConfirmed(const L* landmark) {
  return landmark != nullptr && landmark->observations.size() >= 2;
}

// Every keyframe that observes a landmark counts as one observation like that of the frame. A match
// with a feature of the last frame (nullptr) is as uncertain as the frame's own.
template <typename L>
double MapVariance(const L* landmark) {
  return landmark != nullptr && !landmark->observations.empty()
             ? 1.0 / static_cast<double>(landmark->observations.size())
             : 1.0;
}

template <typename L>
void AddCandidates(const Map& map, const LastFrame& last, const Rigid3& cam_from_world,
                   LocalMap* candidates) {
  const Rigid3 world_from_last = last.CamFromWorld(map).Inverse();
  const Frame& frame = *last.frame;
  const auto& features = FeaturesOf<L>(frame);
  std::vector<LandmarkId> ids(features.size(), kNoId);
  for (const auto& match : OfKind<L>(last.matches)) ids[match.feature] = match.id;
  for (size_t i = 0; i < features.size(); ++i) {
    const L* landmark = map.Find<L>(ids[i]);
    if (landmark == nullptr && !features[i].HasDepth()) continue;
    auto candidate = landmark != nullptr
                         ? CandidateOf(features[i], landmark->id, landmark->geometry())
                         : CandidateOf(features[i], kNoId,
                                       world_from_last * L::InCamera(frame, static_cast<int>(i)));
    if (ProjectCandidate(frame.camera, cam_from_world, &candidate)) {
      OfKind<L>(*candidates).push_back(candidate);
    }
  }
}

}  // namespace

LocalMap CandidatesFromFrame(const Map& map, const LastFrame& last, const Rigid3& cam_from_world) {
  LocalMap candidates;
  candidates.reference = last.reference;
  ForEachLandmarkKind([&](auto kind) {
    AddCandidates<typename decltype(kind)::Landmark>(map, last, cam_from_world, &candidates);
  });
  return candidates;
}

FrameMatches MatchLocalMap(const TrackerOptions& options, const Frame& frame, const LocalMap& local,
                           double radius, const FrameMatches& known) {
  FrameMatches matches = known;
  ForEachLandmarkKind([&](auto kind) {
    using L = typename decltype(kind)::Landmark;
    const Matches<L>& known_matches = known.Of<L>();
    const Matches<L> found =
        MatchFeatures(options.matchers, frame, Unmatched(local.Of<L>(), known_matches), radius,
                      TakenFeatures(known_matches, FeaturesOf<L>(frame).size()));
    matches.Of<L>().insert(matches.Of<L>().end(), found.begin(), found.end());
  });
  return matches;
}

FrameMatches LandmarkInliers(const FrameMatches& matches) {
  FrameMatches inliers;
  ForEachLandmarkKind([&](auto kind) {
    using L = typename decltype(kind)::Landmark;
    for (const auto& match : matches.Of<L>()) {
      if (match.inlier && match.id != kNoId) inliers.Of<L>().push_back(match);
    }
  });
  return inliers;
}

PerKind<int> CountLandmarkInliers(const FrameMatches& matches) {
  PerKind<int> count{};
  ForEachLandmarkKind([&](auto kind) {
    using L = typename decltype(kind)::Landmark;
    for (const auto& match : matches.Of<L>()) {
      count.Of<L>() += match.inlier && match.id != kNoId ? 1 : 0;
    }
  });
  return count;
}

PoseSummary EstimateFramePose(const PoseOptions& options, const Frame& frame, const Map& map,
                              const NoiseScale& scale, const std::vector<PoseFactor>& factors,
                              Rigid3* cam_from_world, FrameMatches* matches) {
  PoseData data;
  data.camera = frame.camera;
  data.cam_from_world = *cam_from_world;
  data.custom_factors = factors;
  ForEachLandmarkKind([&](auto kind) {
    using L = typename decltype(kind)::Landmark;
    for (const auto& match : matches->Of<L>()) {
      const L* landmark = map.Find<L>(match.id);
      auto observed = MakePoseMatch(match, frame, *cam_from_world, landmark, scale);
      observed.map_variance = MapVariance(landmark);
      observed.confirmed = IsConfirmed(landmark);
      OfKind<L>(data).push_back(observed);
    }
  });
  PoseSummary summary = OptimizePose(options, &data);
  *cam_from_world = data.cam_from_world;
  ForEachLandmarkKind([&](auto kind) {
    using L = typename decltype(kind)::Landmark;
    Matches<L>& of_kind = matches->Of<L>();
    const auto& observed = OfKind<L>(data);
    for (size_t i = 0; i < of_kind.size(); ++i) of_kind[i].inlier = observed[i].inlier;
  });
  return summary;
}

int NumMatches(const TrackerOptions& options, const Frame& frame, const PerKind<int>& matches) {
  const bool has_points = frame.points.size() >= static_cast<size_t>(options.min_matches);
  return has_points ? Sum(matches) : Support(matches);
}

bool HasEnoughInliers(const TrackerOptions& options, const Frame& frame, const FramePose& pose) {
  const PoseSummary& summary = pose.summary;
  if (!summary.usable || NumMatches(options, frame, summary.num_inliers) < options.min_matches) {
    return false;
  }
  if (summary.num_confirmed >= options.min_matches) {
    return summary.num_confirmed_inliers >= options.min_inlier_ratio * summary.num_confirmed;
  }
  const int num_static = Sum(SizesOf(pose.matches)) - summary.num_dynamic;
  return Sum(summary.num_inliers) >= options.min_inlier_ratio * num_static;
}

TrackingStatus ClassifyStatus(const TrackerOptions& options, const PoseSummary& pose) {
  const Eigen::Matrix<double, 6, 1> variance = pose.covariance.diagonal();
  const double rotation_sigma = std::sqrt(variance.head<3>().maxCoeff());
  const double translation_sigma = std::sqrt(variance.tail<3>().maxCoeff());
  const bool is_certain = translation_sigma <= options.weak_translation_sigma &&
                          rotation_sigma <= DegreesToRadians(options.weak_rotation_sigma);
  return is_certain ? TrackingStatus::kTracked : TrackingStatus::kWeak;
}

std::optional<FramePose> PoseEstimator::Estimate(const PoseOptions& options, const Frame& frame,
                                                 const Rigid3& start, const FrameMatches& matches) {
  if (NumMatches(options_, frame, SizesOf(matches)) < options_.min_matches) return std::nullopt;
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
