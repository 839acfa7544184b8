// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/tracking/place_search.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "msc_vo/geometry/angles.h"
#include "msc_vo/geometry/quantile.h"
#include "msc_vo/map/path_covariance.h"
#include "msc_vo/matching/local_map.h"
#include "msc_vo/pose_estimation/relocalizer.h"
#include "msc_vo/tracking/frame_pose.h"
#include "msc_vo/tracking/place_verification.h"
#include "msc_vo/tracking/pose_support.h"

namespace msc_vo {

namespace {

// Keyframes to try in 1/30 s, and at least one per frame: bounds the cost.
constexpr int kKeyframesPerInterval = 1;

// Shortest time between two frames that are found in another part of their own map, seconds, so
// that their views differ. A pose in a saved map is waited for, a loop is not.
constexpr double kLoopInterval = 0.2;

constexpr double kIntervalsPerSecond = 30.0;
constexpr double kMaxSeconds = 0.2;  // a gap in the recording leaves no time for a longer search
// The number of intervals is rounded from here on, so that jitter of the stamps decides nothing.
constexpr double kMinRounded = 0.75;

size_t NumKeyframes(const InactiveMaps& maps) {
  size_t count = 0;
  for (const std::shared_ptr<const Map>& map : maps) count += map->keyframes().size();
  return count;
}

// The keyframes of `places` that are, or are not, in a map.
std::vector<KeyframeId> SelectBy(const std::vector<Place>& places, const Map& map, bool in_map) {
  std::vector<KeyframeId> ids;
  for (const Place& place : places) {
    const bool is_in_map = map.FindKeyframe(place.keyframe) != nullptr;
    if (is_in_map == in_map) ids.push_back(place.keyframe);
  }
  return ids;
}

// The keyframes that share landmarks with a frame, given its matches, and those that share
// landmarks with its reference keyframe.
std::set<KeyframeId> NeighboursOf(const FrameMatches& matches, KeyframeId reference,
                                  const Map& map) {
  std::set<KeyframeId> neighbours{reference};
  for (const Map::Covisible& observer : RankObservers(map, matches)) {
    neighbours.insert(observer.keyframe);
  }
  for (const Map::Covisible& covisible : map.FindCovisible(reference)) {
    neighbours.insert(covisible.keyframe);
  }
  return neighbours;
}

// Of the points of a frame, metres; 0 without any.
double MedianDepth(const Frame& frame) {
  std::vector<double> depths;
  for (const PointFeature& point : frame.points) {
    if (point.inverse_depth > 0.0) depths.push_back(1.0 / point.inverse_depth);
  }
  return depths.empty() ? 0.0 : UpperMedian(std::move(depths));
}

// Covariance of the pose of a frame relative to a keyframe, apart from the landmarks that it was
// tracked with, in its camera frame. `paths`: from its reference keyframe.
PoseCovariance CovarianceSince(const TrackedFrame& tracked, const PathCovariances& paths,
                               KeyframeId keyframe) {
  return TransportCovariance(tracked.cam_from_reference, paths.OfRoot(keyframe)) +
         CameraCovariance(tracked.cam_from_world, tracked.pose.covariance);
}

// Whether a frame and a keyframe can show the same surface, which is some `reach` metres away: the
// keyframe is that near and looks in a similar direction, to three sigmas of the path between them.
bool CanShowSame(const TrackedFrame& tracked, const Keyframe& keyframe, double reach,
                 const PoseCovariance& covariance) {
  constexpr double kMaxAngle = DegreesToRadians(60.0);  // features do not look alike beyond
  const double rotation_sigma = std::sqrt(covariance.topLeftCorner<3, 3>().trace());
  const double translation_sigma = std::sqrt(covariance.bottomRightCorner<3, 3>().trace());
  const Rigid3 cam_from_keyframe = tracked.cam_from_world * keyframe.cam_from_world.Inverse();
  const Eigen::Vector3d axis = cam_from_keyframe.rotation() * Eigen::Vector3d::UnitZ();
  const double angle = std::atan2(axis.head<2>().norm(), axis.z());
  return angle < kMaxAngle + 3.0 * rotation_sigma &&
         cam_from_keyframe.translation().norm() < reach + 3.0 * translation_sigma;
}

// Whether the drift of the path can be as large as the correction by a revisit. `paths`: from the
// reference keyframe of the frame.
bool IsPossible(const TrackedFrame& tracked, const Map& map, const PathCovariances& paths,
                const Revisit& revisit) {
  const Rigid3 by_path = tracked.cam_from_world * map.CamFromWorld(revisit.reference).Inverse();
  return IsPossibleDrift(by_path, revisit.cam_from_reference,
                         CovarianceSince(tracked, paths, revisit.reference) + revisit.covariance);
}

}  // namespace

int KeyframesToTry(int keyframes_per_interval, double seconds, size_t num_keyframes) {
  double intervals = kIntervalsPerSecond * std::min(seconds, kMaxSeconds);
  if (intervals >= kMinRounded) intervals = std::round(intervals);
  const int num_in_time = static_cast<int>(std::lround(keyframes_per_interval * intervals));
  const int num_different = std::max(keyframes_per_interval, static_cast<int>(num_keyframes));
  return std::clamp(num_in_time, 1, num_different);
}

std::vector<KeyframeId> TryOrder::Select(const std::vector<KeyframeId>& ranked, int num) {
  std::vector<KeyframeId> selected;
  if (ranked.empty()) return selected;
  const size_t size = std::min<size_t>(num, ranked.size());
  if (size > 1 || ranked.size() == 1 || num_frames_ % 2 == 0) selected.push_back(ranked.front());
  ++num_frames_;
  while (selected.size() < size) {
    selected.push_back(ranked[1 + num_others_ % (ranked.size() - 1)]);
    ++num_others_;
  }
  return selected;
}

void PlaceSearch::Update(const MapSnapshot& snapshot) {
  const size_t num_keyframes =
      snapshot.map.keyframes().size() + NumKeyframes(snapshot.inactive_maps);
  if (snapshot.newest_keyframe == newest_ && num_keyframes == num_keyframes_) return;
  index_.Update(snapshot);
  look_alikes_.Update(snapshot);
  newest_ = snapshot.newest_keyframe;
  num_keyframes_ = num_keyframes;
}

std::vector<KeyframeId> PlaceSearch::SelectKeyframes(const Frame& frame, const Map& map, int num,
                                                     TryOrder* order) const {
  return order->Select(SelectBy(Rank(frame), map, true), num);
}

std::optional<Revisit> PlaceSearch::FindRevisit(const TrackedFrame& tracked, bool is_keyframe,
                                                const MapSnapshot& snapshot, double seconds) {
  if (tracked.status != TrackingStatus::kTracked) return std::nullopt;
  const double timestamp = tracked.frame->timestamp;
  const double pause = timestamp - last_success_;
  if (pause < options_.segments.search_interval) return std::nullopt;
  std::optional<Revisit> found = FindInInactiveMaps(tracked, snapshot, seconds);
  if (!found && is_keyframe && options_.find_loops && pause >= kLoopInterval) {
    found = FindLoop(tracked, snapshot);
  }
  if (found) last_success_ = timestamp;
  return found;
}

std::optional<Revisit> PlaceSearch::FindInInactiveMaps(const TrackedFrame& tracked,
                                                       const MapSnapshot& snapshot,
                                                       double seconds) {
  const InactiveMaps& maps = snapshot.inactive_maps;
  if (maps.empty()) return std::nullopt;
  const int num = KeyframesToTry(kKeyframesPerInterval, seconds, NumKeyframes(maps));
  const std::vector<Place> places = Rank(*tracked.frame);
  for (const KeyframeId id : order_.Select(SelectBy(places, snapshot.map, false), num)) {
    const Map& map = *FindMapOf(maps, id);
    std::optional<Revisit> found =
        Relocalize(tracked, snapshot.noise_scale, map, *map.FindKeyframe(id));
    if (!found || ContradictsSurfaces(tracked, snapshot.map, *found, map)) continue;
    // Between maps of one session, MapJoiner tests the motion instead.
    const bool is_ambiguous =
        map.IsOfEarlierSession(id) && IsCoplanar(*found, map, options_.min_matches);
    if (is_ambiguous) continue;
    const std::optional<Revisit> rival = FindRival(tracked, snapshot, map, *found, places);
    const bool is_certain =
        !rival && look_alikes_.AreExcluded(options_, tracked, snapshot, map, *found);
    if (is_certain) return found;
    look_alikes_.Add(tracked, snapshot, map, *found);
    if (rival) look_alikes_.Add(tracked, snapshot, map, *rival);
    return std::nullopt;
  }
  return std::nullopt;
}

std::optional<Revisit> PlaceSearch::FindRival(const TrackedFrame& tracked,
                                              const MapSnapshot& snapshot, const Map& map,
                                              const Revisit& found,
                                              const std::vector<Place>& places) const {
  // A rival whose surfaces contradict the frame still counts: it may be the right place, in which
  // something was moved.
  constexpr int kMaxRivals = 3;  // bounds the cost
  const std::set<KeyframeId> neighbours = NeighboursOf(found.matches, found.reference, map);
  const Rigid3 cam_from_world = found.cam_from_reference * map.CamFromWorld(found.reference);
  int num_rivals = 0;
  for (const Place& place : places) {
    const Keyframe* keyframe = map.FindKeyframe(place.keyframe);
    if (keyframe == nullptr || neighbours.count(place.keyframe) > 0) continue;
    if (++num_rivals > kMaxRivals) break;
    std::optional<Revisit> rival = Relocalize(tracked, snapshot.noise_scale, map, *keyframe);
    if (!rival) continue;
    // Poses that differ by no more than the drift between two visits are one place.
    const PathCovariances paths(map, snapshot.loops, found.reference);
    const bool is_same = IsPossibleDrift(
        cam_from_world * map.CamFromWorld(rival->reference).Inverse(), rival->cam_from_reference,
        TransportCovariance(found.cam_from_reference, paths.OfRoot(rival->reference)) +
            found.covariance + rival->covariance);
    if (!is_same) return rival;
  }
  return std::nullopt;
}

std::optional<Revisit> PlaceSearch::FindLoop(const TrackedFrame& tracked,
                                             const MapSnapshot& snapshot) const {
  const Map& map = snapshot.map;
  if (map.FindKeyframe(tracked.reference) == nullptr) return std::nullopt;
  const std::set<KeyframeId> neighbours = NeighboursOf(tracked.matches, tracked.reference, map);
  if (neighbours.size() == map.keyframes().size()) return std::nullopt;
  const double reach = MedianDepth(*tracked.frame);
  const PathCovariances paths(map, snapshot.loops, tracked.reference);
  for (const Place& place : Rank(*tracked.frame)) {
    const Keyframe* keyframe = map.FindKeyframe(place.keyframe);
    if (keyframe == nullptr || neighbours.count(place.keyframe) > 0) continue;
    const PoseCovariance covariance = CovarianceSince(tracked, paths, keyframe->id);
    if (!CanShowSame(tracked, *keyframe, reach, covariance)) continue;
    std::optional<Revisit> found = Relocalize(tracked, snapshot.noise_scale, map, *keyframe);
    const bool is_accepted = found && IsPossible(tracked, map, paths, *found) &&
                             !ContradictsSurfaces(tracked, map, *found, map);
    return is_accepted ? found : std::nullopt;
  }
  return std::nullopt;
}

std::optional<Revisit> PlaceSearch::Relocalize(const TrackedFrame& tracked,
                                               const NoiseScale& noise_scale, const Map& map,
                                               const Keyframe& keyframe) const {
  const Frame& frame = *tracked.frame;
  const std::optional<Relocalization> hit = msc_vo::Relocalize(
      options_.relocalizer, options_.matchers.line_matcher, frame, map, keyframe);
  if (!hit) return std::nullopt;
  const std::vector<PoseFactor> no_factors;
  PoseEstimator estimator(options_, map, noise_scale, no_factors);
  const std::optional<FramePose> first =
      estimator.Estimate(options_.pose, frame, hit->cam_from_world, hit->matches);
  if (!first) return std::nullopt;
  // The local map confirms the pose with the landmarks of several keyframes.
  const LocalMap local = SelectLocalMap(map, frame, first->cam_from_world, first->matches,
                                        keyframe.id, options_.max_local_keyframes);
  const std::optional<FramePose> pose =
      estimator.MatchAndEstimate(options_.pose, frame, local, options_.local_map_radius,
                                 first->cam_from_world, LandmarkInliers(first->matches));
  if (!pose || ClassifyStatus(options_, pose->summary) != TrackingStatus::kTracked) {
    return std::nullopt;
  }
  const FrameMatches matches = LandmarkInliers(pose->matches);
  const MatchCounts at_place{SizesOf(local), Sum(SizesOf(matches))};
  const MatchCounts in_own_map{SizesOf(tracked.visible), Sum(SizesOf(tracked.matches))};
  if (!HasComparableMatchRatio(frame, at_place, in_own_map)) return std::nullopt;
  return Revisit{local.reference,
                 pose->cam_from_world * map.CamFromWorld(local.reference).Inverse(),
                 CameraCovariance(pose->cam_from_world, pose->summary.covariance), matches};
}

}  // namespace msc_vo
