// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/tracking/frame_pose.h"

#include <algorithm>
#include <cmath>

#include "msc_vo/bundle_adjustment/observation.h"
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

template <typename M>
std::vector<M> LandmarkInliersOf(const std::vector<M>& matches) {
  std::vector<M> inliers;
  for (const M& match : matches) {
    if (match.inlier && match.id != kNoId) inliers.push_back(match);
  }
  return inliers;
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

// The sigmas of the feature are multiplied by the calibrated scale and the noise of the landmark
// (nullptr: the match is with a feature of the last frame).
PoseData::Point Observe(const PointMatch& match, const Frame& frame,
                        const Rigid3& /*cam_from_world*/, const PointLandmark* landmark,
                        const NoiseScale& scale) {
  const PointFeature& feature = frame.points[match.feature];
  const double noise = landmark != nullptr ? landmark->noise : 1.0;
  return {match.position,
          feature.pixel,
          noise * feature.sigma,
          feature.inverse_depth,
          noise * scale.point_depth * feature.inverse_depth_sigma,
          MapVariance(landmark),
          IsConfirmed(landmark)};
}

// Of a line that passes the camera at `cam_from_world`, only the visible part is observed.
PoseData::Line Observe(const LineMatch& match, const Frame& frame, const Rigid3& cam_from_world,
                       const LineLandmark* landmark, const NoiseScale& scale) {
  const LineFeature& feature = frame.lines[match.feature];
  const LinePart part = ObservedPart(frame.camera, feature.segment, cam_from_world * match.segment)
                            .value_or(LinePart());
  const double noise = landmark != nullptr ? landmark->noise : 1.0;
  LineDepth depth = feature.depth.value_or(LineDepth());
  if (landmark != nullptr) depth = Nearer(depth, landmark->depth_offset);
  depth.covariance *= noise * noise * scale.line_depth * scale.line_depth;
  return {part.Of(match.segment),    feature.segment, noise * scale.line_pixel * feature.sigma,
          feature.depth.has_value(), depth,           MapVariance(landmark),
          IsConfirmed(landmark)};
}

PointCandidate MakeCandidate(const PointFeature& feature, LandmarkId id,
                             const Eigen::Vector3d& position) {
  return {id, position, feature.descriptor, Eigen::Vector2d::Zero(), feature.level};
}
LineCandidate MakeCandidate(const LineFeature& feature, LandmarkId id,
                            const LineSegment3& segment) {
  return {id, segment, feature.descriptor, {}};
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
    if (landmark == nullptr && !L::HasDepth(features[i])) continue;
    auto candidate = landmark != nullptr
                         ? MakeCandidate(features[i], landmark->id, landmark->geometry())
                         : MakeCandidate(features[i], kNoId,
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
  const std::vector<PointMatch> points =
      MatchPoints(options.point_matcher, frame, Unmatched(local.points, known.points), radius,
                  TakenFeatures(known.points, frame.points.size()));
  matches.points.insert(matches.points.end(), points.begin(), points.end());
  const std::vector<LineMatch> lines =
      MatchLines(options.line_matcher, frame, Unmatched(local.lines, known.lines), radius,
                 TakenFeatures(known.lines, frame.lines.size()));
  matches.lines.insert(matches.lines.end(), lines.begin(), lines.end());
  return matches;
}

FrameMatches LandmarkInliers(const FrameMatches& matches) {
  return {LandmarkInliersOf(matches.points), LandmarkInliersOf(matches.lines)};
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
    for (const auto& match : OfKind<L>(*matches)) {
      OfKind<L>(data).push_back(
          Observe(match, frame, *cam_from_world, map.Find<L>(match.id), scale));
    }
  });
  PoseSummary summary = OptimizePose(options, &data);
  *cam_from_world = data.cam_from_world;
  ForEachLandmarkKind([&](auto kind) {
    auto& of_kind = OfKind<typename decltype(kind)::Landmark>(*matches);
    const auto& observed = OfKind<typename decltype(kind)::Landmark>(data);
    for (size_t i = 0; i < of_kind.size(); ++i) of_kind[i].inlier = observed[i].inlier;
  });
  return summary;
}

int NumMatches(const TrackerOptions& options, const Frame& frame, size_t num_points,
               size_t num_lines) {
  const bool has_points = frame.points.size() >= static_cast<size_t>(options.min_matches);
  return static_cast<int>(num_points + (has_points ? 1 : kPointsPerLine) * num_lines);
}

bool HasEnoughInliers(const TrackerOptions& options, const Frame& frame, const FramePose& pose) {
  const PoseSummary& summary = pose.summary;
  const int support =
      NumMatches(options, frame, summary.num_inlier_points, summary.num_inlier_lines);
  if (!summary.usable || support < options.min_matches) return false;
  if (summary.num_confirmed >= options.min_matches) {
    return summary.num_confirmed_inliers >= options.min_inlier_ratio * summary.num_confirmed;
  }
  const int num_matches = static_cast<int>(pose.matches.points.size() + pose.matches.lines.size());
  const int num_static = num_matches - summary.num_dynamic;
  return summary.num_inlier_points + summary.num_inlier_lines >=
         options.min_inlier_ratio * num_static;
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
