// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/tracking/tracker.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include "msc_vo/geometry/angles.h"
#include "msc_vo/map/feature_counts.h"
#include "msc_vo/map/rolling_shutter.h"
#include "msc_vo/matching/local_map.h"
#include "msc_vo/timing/stopwatch.h"
#include "msc_vo/tracking/moving_features.h"
#include "msc_vo/tracking/pose_estimation.h"

namespace msc_vo {

namespace {

// Pose of a tracked frame, with its reference keyframe where the map has it now.
Rigid3 CamFromWorld(const Map& map, const TrackedFrame& tracked) {
  if (tracked.reference == kNoId) return tracked.cam_from_world;
  return tracked.cam_from_reference * map.CamFromWorld(tracked.reference);
}

// The keyframe of the map that stands for `id`, which may have been removed: the newest one then.
KeyframeId LivingReference(const Map& map, KeyframeId id) {
  return map.FindKeyframe(id) != nullptr ? id : map.keyframes().back().first;
}

void SetReference(const Map& map, KeyframeId reference, TrackedFrame* tracked) {
  tracked->reference = reference;
  tracked->cam_from_reference = tracked->cam_from_world * map.CamFromWorld(reference).Inverse();
}

// If `keyframe` is what became of `tracked`, takes over its place and its landmarks. Its frame is
// another one, with the structure that the mapper gave it; but no two have the same time.
void AdoptKeyframe(const Keyframe& keyframe, TrackedFrame* tracked) {
  if (keyframe.frame->timestamp != tracked->frame->timestamp) return;
  tracked->reference = keyframe.id;
  tracked->cam_from_reference = Rigid3();
  tracked->matches = {};
  for (size_t i = 0; i < keyframe.points.size(); ++i) {
    if (keyframe.points[i] == kNoId) continue;
    tracked->matches.points.push_back(
        {static_cast<int>(i), keyframe.points[i], Eigen::Vector3d::Zero(), true});
  }
  for (size_t i = 0; i < keyframe.lines.size(); ++i) {
    if (keyframe.lines[i] == kNoId) continue;
    tracked->matches.lines.push_back(
        {static_cast<int>(i), keyframe.lines[i], LineSegment3(), true});
  }
}

int NumMatches(const FrameMatches& matches) {
  return static_cast<int>(matches.points.size() + matches.lines.size());
}

// Whether the map knows its only keyframe as its rows were taken: nothing told its velocity yet.
bool IsRolled(const MapSnapshot& snapshot) {
  const Map::KeyframeTable& keyframes = snapshot.map.keyframes();
  return keyframes.size() == 1 && !keyframes.back().second.frame->velocity;
}

// What frames are unrolled with so that they look as the map does.
double ReadoutTime(const MapSnapshot& snapshot) {
  return IsRolled(snapshot) ? 0.0 : snapshot.readout_time;
}

std::shared_ptr<const Frame> Unrolled(std::shared_ptr<const Frame> rolled,
                                      const std::optional<CameraVelocity>& velocity,
                                      double readout_time) {
  if (!velocity) return rolled;
  return std::make_shared<Frame>(Unroll(*rolled, *velocity, readout_time));
}

// Of the pose that the local map is projected with: it is found once more, from what matches then.
// The robust rounds are enough for that; the others take 0.2 ms and change no error by 1 %.
PoseOptions RoughPoseOptions(PoseOptions options) {
  options.num_rounds = std::max(1, options.num_robust_rounds);
  return options;
}

}  // namespace

Tracker::Tracker(const TrackerOptions& options)
    : options_(options), rough_pose_(RoughPoseOptions(options.pose)), policy_(options.keyframes) {
  std::string error;
  if (!options.IsValid(&error)) throw std::invalid_argument(error);
}

TrackedFrame Tracker::Track(std::shared_ptr<const Frame> rolled, const MapSnapshot& snapshot) {
  const Map& map = snapshot.map;
  if (map.keyframes().empty()) return Initialize(std::move(rolled));

  if (last_.is_keyframe) AdoptKeyframe(*map.FindKeyframe(snapshot.newest_keyframe), &last_);
  TrackedFrame tracked;
  const double timestamp = rolled->timestamp;
  const double readout_time = ReadoutTime(snapshot);
  tracked.frame =
      readout_time == 0.0 ? rolled : Unrolled(rolled, motion_.VelocityAt(timestamp), readout_time);
  tracked.noise_scale = snapshot.noise_scale;
  const Rigid3 last_from_world = CamFromWorld(map, last_);
  const Rigid3 prediction = motion_.Predict(timestamp) * last_from_world;
  const bool found = TrackMotion(map, prediction, options_.prediction_radius, &tracked) ||
                     TrackMotion(map, prediction, options_.wide_radius, &tracked) ||
                     TrackReference(map, prediction, &tracked) || TrackByAppearance(map, &tracked);
  if (!found) {
    const double gap = timestamp - last_.frame->timestamp;
    tracked.status =
        gap <= options_.max_prediction ? TrackingStatus::kPredicted : TrackingStatus::kLost;
    tracked.matches = {};
    tracked.pose = {};
    tracked.cam_from_world = prediction;
    SetReference(map, LivingReference(map, last_.reference), &tracked);
    return tracked;
  }
  // Once more, now that it is known how the camera has moved.
  const Rigid3 cam_from_last = tracked.cam_from_world * last_from_world.Inverse();
  tracked.frame = Unrolled(rolled, motion_.VelocitySince(timestamp, cam_from_last), readout_time);
  tracked.status = TrackLocalMap(map, &tracked) ? Judge(tracked) : TrackingStatus::kWeak;
  tracked.is_keyframe = IsKeyframeDue(snapshot, tracked);
  if (tracked.is_keyframe) {
    policy_.Inserted();
    tracked.frame = MarkMovingFeatures(options_.pose.consensus, tracked);
  }
  Remember(last_from_world, &tracked);
  return tracked;
}

TrackedFrame Tracker::Initialize(std::shared_ptr<const Frame> frame) {
  TrackedFrame tracked;
  tracked.frame = std::move(frame);
  if (NumWithDepth(*tracked.frame) < options_.min_initial_features) return tracked;
  tracked.status = TrackingStatus::kTracked;
  tracked.is_keyframe = true;
  policy_.Inserted();
  motion_.Reset(tracked.frame->timestamp);
  last_ = tracked;
  return tracked;
}

bool Tracker::TrackMotion(const Map& map, const Rigid3& prediction, double radius,
                          TrackedFrame* tracked) const {
  Stopwatch stopwatch;
  const LocalMap seen = CandidatesFromFrame(map, last_, CamFromWorld(map, last_), prediction);
  tracked->cam_from_world = prediction;
  tracked->matches = MatchLocalMap(options_, *tracked->frame, seen, radius, {});
  tracked->matching_ms += stopwatch.Milliseconds();
  return EstimatePose(rough_pose_, map, tracked);
}

bool Tracker::TrackReference(const Map& map, const Rigid3& prediction,
                             TrackedFrame* tracked) const {
  Stopwatch stopwatch;
  const LocalMap local =
      SelectLocalMap(map, *tracked->frame, prediction, {}, LivingReference(map, last_.reference),
                     options_.max_local_keyframes);
  tracked->cam_from_world = prediction;
  tracked->matches = MatchLocalMap(options_, *tracked->frame, local, options_.wide_radius, {});
  tracked->matching_ms += stopwatch.Milliseconds();
  return EstimatePose(rough_pose_, map, tracked);
}

bool Tracker::TrackByAppearance(const Map& map, TrackedFrame* tracked) {
  for (int i = 0; i < options_.relocalization_keyframes; ++i) {
    // From newest to oldest, a few per frame, and around again.
    const auto* keyframe = map.keyframes().FindUpTo(next_candidate_);
    if (keyframe == nullptr) keyframe = &map.keyframes().back();
    next_candidate_ = keyframe->first - 1;
    Stopwatch stopwatch;
    const std::optional<Relocalization> hit =
        Relocalize(options_.relocalizer, *tracked->frame, map, keyframe->second);
    tracked->matching_ms += stopwatch.Milliseconds();
    if (!hit) continue;
    tracked->cam_from_world = hit->cam_from_world;
    tracked->matches = hit->matches;
    if (EstimatePose(rough_pose_, map, tracked)) {
      next_candidate_ = kNoId;
      return true;
    }
  }
  return false;
}

bool Tracker::TrackLocalMap(const Map& map, TrackedFrame* tracked) const {
  Stopwatch stopwatch;
  const TrackedFrame before = *tracked;
  const LocalMap local =
      SelectLocalMap(map, *tracked->frame, tracked->cam_from_world, tracked->matches,
                     LivingReference(map, last_.reference), options_.max_local_keyframes);
  tracked->matches = MatchLocalMap(options_, *tracked->frame, local, options_.local_map_radius,
                                   LandmarkInliers(tracked->matches));
  for (const PointCandidate& point : local.points) tracked->visible_points.push_back(point.id);
  for (const LineCandidate& line : local.lines) tracked->visible_lines.push_back(line.id);
  tracked->matching_ms += stopwatch.Milliseconds();
  const bool found = EstimatePose(options_.pose, map, tracked);
  if (!found) {
    // The map is thin here, but the last frame was found again: that pose holds.
    tracked->pose = before.pose;
    tracked->matches = before.matches;
  }
  tracked->matches = LandmarkInliers(tracked->matches);
  SetReference(map, local.reference, tracked);
  return found;
}

bool Tracker::EstimatePose(const PoseOptions& options, const Map& map,
                           TrackedFrame* tracked) const {
  if (NumMatches(tracked->matches) < options_.min_matches) return false;
  Stopwatch stopwatch;
  const Rigid3 start = tracked->cam_from_world;
  tracked->pose = EstimateFramePose(options, *tracked->frame, map, tracked->noise_scale,
                                    &tracked->cam_from_world, &tracked->matches);
  tracked->pose_ms += stopwatch.Milliseconds();
  const int num_inliers = tracked->pose.num_inlier_points + tracked->pose.num_inlier_lines;
  const int num_resting = NumMatches(tracked->matches) - tracked->pose.num_moving;
  const bool good = tracked->pose.usable && num_inliers >= options_.min_matches &&
                    num_inliers >= options_.min_inlier_ratio * num_resting;
  if (!good) {
    tracked->cam_from_world = start;
  } else if (tracked->pose.num_moving > tracked->num_moving) {
    tracked->num_moving = tracked->pose.num_moving;
    tracked->moving_parts = tracked->pose.moving_parts;
  }
  return good;
}

bool Tracker::IsKeyframeDue(const MapSnapshot& snapshot, const TrackedFrame& tracked) {
  // The second frame tells the velocity of the first, so that the map can be unrolled.
  const Keyframe& newest = snapshot.map.keyframes().back().second;
  const bool is_second = last_.frame->timestamp == newest.frame->timestamp;
  if (snapshot.readout_time != 0.0 && IsRolled(snapshot) && is_second) return true;
  return policy_.IsDue(*tracked.frame, tracked.matches);
}

void Tracker::Remember(const Rigid3& last_from_world, TrackedFrame* tracked) {
  const double timestamp = tracked->frame->timestamp;
  if (timestamp - last_.frame->timestamp <= options_.max_prediction) {
    const Rigid3 cam_from_last = tracked->cam_from_world * last_from_world.Inverse();
    if (last_.is_keyframe) {
      tracked->last_keyframe_velocity = motion_.LastVelocity(timestamp, cam_from_last);
    }
    motion_.Observe(timestamp, cam_from_last);
  } else {
    motion_.Reset(timestamp);
  }
  last_ = *tracked;
}

TrackingStatus Tracker::Judge(const TrackedFrame& tracked) const {
  const Eigen::Matrix<double, 6, 1> variance = tracked.pose.covariance.diagonal();
  const double rotation_sigma = std::sqrt(variance.head<3>().maxCoeff());
  const double translation_sigma = std::sqrt(variance.tail<3>().maxCoeff());
  const bool sharp = translation_sigma <= options_.weak_translation_sigma &&
                     rotation_sigma <= DegreesToRadians(options_.weak_rotation_sigma);
  return sharp ? TrackingStatus::kTracked : TrackingStatus::kWeak;
}

}  // namespace msc_vo
