// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/tracking/tracker.h"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>

#include "msc_vo/frame/feature_counts.h"
#include "msc_vo/frame/frame_intrinsics.h"
#include "msc_vo/frame/rolling_shutter.h"
#include "msc_vo/matching/local_map.h"
#include "msc_vo/pose_estimation/pose_search.h"
#include "msc_vo/timing/stopwatch.h"
#include "msc_vo/tracking/dynamic_features.h"
#include "msc_vo/tracking/frame_compensation.h"
#include "msc_vo/tracking/frame_pose.h"

namespace msc_vo {

namespace {

// Pose of a tracked frame with its reference keyframe as in `map`.
Rigid3 CamFromWorld(const Map& map, const TrackedFrame& tracked) {
  if (tracked.reference == kNoId) return tracked.cam_from_world;
  return tracked.cam_from_reference * map.CamFromWorld(tracked.reference);
}

// The keyframe `id`, or the newest keyframe if it was removed from the map.
KeyframeId ReferenceOrNewest(const Map& map, KeyframeId id) {
  return map.FindKeyframe(id) != nullptr ? id : map.keyframes().back().first;
}

void SetReference(const Map& map, KeyframeId reference, TrackedFrame* tracked) {
  tracked->reference = reference;
  tracked->cam_from_reference = tracked->cam_from_world * map.CamFromWorld(reference).Inverse();
}

// If `keyframe` was created from `tracked`, takes over its pose and its landmarks. The keyframe has
// a frame of its own, whose lines the mapper may have refined; the time stamp identifies it.
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

// Options for the initial pose, which the local map is projected with. The pose is optimised again
// with the local map, so that the robust rounds suffice here.
PoseOptions InitialPoseOptions(PoseOptions options) {
  options.num_rounds = std::max(1, options.num_robust_rounds);
  return options;
}

// Poses of a search without a prediction that are tried.
constexpr int kMaxSearchPoses = 5;

}  // namespace

Tracker::Tracker(const TrackerOptions& options)
    : options_(options),
      initial_pose_(InitialPoseOptions(options.pose)),
      policy_(options.keyframes),
      segment_start_(options.segments),
      inactive_map_search_(options) {
  std::string error;
  if (!options.IsValid(&error)) throw std::invalid_argument(error);
}

TrackedFrame Tracker::Track(std::shared_ptr<const Frame> raw, const MapSnapshot& snapshot) {
  const Map& map = snapshot.map;
  if (map.keyframes().empty()) return Initialize(std::move(raw));

  last_.frame = ChangeIntrinsics(last_.frame, snapshot.intrinsics);
  if (last_.keyframe.is_due) AdoptKeyframe(*map.FindKeyframe(snapshot.newest_keyframe), &last_);
  const double timestamp = raw->timestamp;
  const double readout_time = CompensationReadoutTime(snapshot);
  const Rigid3 last_from_world = CamFromWorld(map, last_);

  TrackedFrame tracked;
  tracked.noise_scale = snapshot.noise_scale;
  tracked.frame =
      readout_time == 0.0 ? raw : CompensateFrame(raw, motion_.VelocityAt(timestamp), readout_time);
  const Prediction prediction = Predict(map, last_from_world, tracked);
  if (!TrackInitialPose(map, prediction, &tracked)) {
    in_gap_ = true;
    BridgeWithPrediction(map, prediction, &tracked);
    if (IsNewSegmentDue(map, tracked)) return BeginSegment(std::move(raw), last_from_world);
    if (!IsOutsideMappedArea(map, tracked)) return tracked;
    tracked.keyframe.is_due = true;
    policy_.Inserted(timestamp);
    UpdateMotion(last_from_world, &tracked);
    last_ = tracked;
    return tracked;
  }
  // The initial pose yields the velocity since the last frame: compensate again.
  const Rigid3 cam_from_last = tracked.cam_from_world * last_from_world.Inverse();
  tracked.frame =
      CompensateFrame(raw, motion_.VelocitySince(timestamp, cam_from_last), readout_time);
  tracked.status =
      TrackLocalMap(map, &tracked) ? ClassifyStatus(options_, tracked.pose) : TrackingStatus::kWeak;
  if (!UpdatePlausibility(map, tracked, last_from_world, prediction)) {
    tracked.status = TrackingStatus::kWeak;
  }
  in_gap_ = false;
  ProposeKeyframe(snapshot, &tracked);
  segment_start_.Tracked(timestamp);
  UpdateMotion(last_from_world, &tracked);
  last_ = tracked;
  return tracked;
}

TrackedFrame Tracker::Initialize(std::shared_ptr<const Frame> frame) {
  TrackedFrame tracked;
  tracked.frame = std::move(frame);
  if (!CanBeginMap(*tracked.frame, options_.min_initial_features)) return tracked;
  StartSegment(SegmentStart::kFirst, &tracked);
  return tracked;
}

// The map of the segment begins where the camera was seen last. That is no measurement, but keeps
// the trajectory continuous.
TrackedFrame Tracker::BeginSegment(std::shared_ptr<const Frame> frame,
                                   const Rigid3& last_from_world) {
  TrackedFrame tracked;
  tracked.frame = std::move(frame);
  tracked.cam_from_world = last_from_world;
  tracked.cam_from_reference = last_from_world;
  tracked.keyframe.last_tracked = {last_.frame->timestamp, last_.reference,
                                   last_.cam_from_reference};
  StartSegment(segment_start_.is_confirmed() ? SegmentStart::kAfterLoss : SegmentStart::kReplacing,
               &tracked);
  return tracked;
}

void Tracker::StartSegment(SegmentStart start, TrackedFrame* tracked) {
  tracked->status = TrackingStatus::kTracked;
  tracked->segment_start = start;
  tracked->keyframe.is_due = true;
  policy_.Inserted(tracked->frame->timestamp);
  motion_.Reset(tracked->frame->timestamp);
  plausibility_ = PosePlausibility();
  in_gap_ = false;
  segment_start_.Started(tracked->frame->timestamp);
  next_candidate_ = kNoId;
  last_ = *tracked;
}

bool Tracker::IsNewSegmentDue(const Map& map, const TrackedFrame& tracked) {
  const double timestamp = tracked.frame->timestamp;
  if (tracked.pose.usable) {
    segment_start_.Tracked(timestamp);  // by pose factors, which keep the camera in the map
    return false;
  }
  const bool could_begin = CanBeginMap(*tracked.frame, options_.min_initial_features);
  segment_start_.NotFound(timestamp, could_begin, NumKeyframesToTry(map, timestamp));
  if (!could_begin || tracked.status != TrackingStatus::kLost) return false;
  return segment_start_.IsDue(static_cast<int>(map.keyframes().size()));
}

Tracker::Prediction Tracker::Predict(const Map& map, const Rigid3& last_from_world,
                                     const TrackedFrame& tracked) {
  const double timestamp = tracked.frame->timestamp;
  Prediction prediction{motion_.Predict(timestamp) * last_from_world, {}};
  if (!pose_factor_callback_) return prediction;
  pose_factors_ = pose_factor_callback_(
      {timestamp, last_.frame->timestamp, last_from_world, prediction.cam_from_world});
  if (pose_factors_.empty()) return prediction;
  FrameMatches none;
  prediction.by_factors = EstimateFramePose(options_.pose, *tracked.frame, map, tracked.noise_scale,
                                            pose_factors_, &prediction.cam_from_world, &none);
  return prediction;
}

bool Tracker::TrackInitialPose(const Map& map, const Prediction& prediction,
                               TrackedFrame* tracked) {
  const Rigid3& pose = prediction.cam_from_world;
  TrackedFrame far = *tracked;
  const PoseFit near_fit = TrackLastFrame(map, pose, options_.prediction_radius, tracked);
  if (near_fit == PoseFit::kClear) return true;
  const bool is_far = TrackLargeMotion(map, pose, &far);
  tracked->times += far.times;
  if (is_far &&
      (near_fit == PoseFit::kNone || IsClearlyBetter(options_, far.pose, tracked->pose))) {
    far.times = tracked->times;
    *tracked = far;
    tracked->searched = true;
    return true;
  }
  return near_fit != PoseFit::kNone || TrackMapAround(map, prediction, tracked) ||
         Relocalize(map, tracked);
}

bool Tracker::TrackLargeMotion(const Map& map, const Rigid3& prediction,
                               TrackedFrame* tracked) const {
  Stopwatch stopwatch;
  const Rigid3 last_from_world = CamFromWorld(map, last_);
  const LocalMap last = CandidatesFromFrame(map, last_, last_from_world, last_from_world);
  const std::vector<Relocalization> poses = FindPoses(options_.relocalizer, options_.line_matcher,
                                                      *tracked->frame, last, kMaxSearchPoses);
  TrackingTimes times;
  times.matching = stopwatch.Milliseconds();

  const TrackedFrame start = *tracked;
  bool found = false;
  const auto try_pose = [&](const Rigid3& pose, double radius) {
    TrackedFrame attempt = start;
    const PoseFit fit = TrackLastFrame(map, pose, radius, &attempt);
    times += attempt.times;
    if (fit == PoseFit::kNone) return;
    if (!found || Support(attempt.pose) > Support(tracked->pose)) *tracked = attempt;
    found = true;
  };
  try_pose(prediction, options_.wide_radius);
  for (const Relocalization& pose : poses) {
    try_pose(pose.cam_from_world, options_.prediction_radius);
  }
  tracked->times = times;
  return found;
}

void Tracker::BridgeWithPrediction(const Map& map, const Prediction& prediction,
                                   TrackedFrame* tracked) const {
  const double gap = tracked->frame->timestamp - last_.frame->timestamp;
  const bool is_known = prediction.by_factors.usable || gap <= options_.max_prediction;
  tracked->status = is_known ? TrackingStatus::kPredicted : TrackingStatus::kLost;
  tracked->matches = {};
  tracked->pose = prediction.by_factors;
  tracked->cam_from_world = prediction.cam_from_world;
  SetReference(map, ReferenceOrNewest(map, last_.reference), tracked);
}

bool Tracker::IsOutsideMappedArea(const Map& map, const TrackedFrame& tracked) const {
  if (!tracked.pose.usable || !CanBeginMap(*tracked.frame, options_.min_initial_features)) {
    return false;
  }
  const LocalMap visible = SelectVisibleLandmarks(map, *tracked.frame, tracked.cam_from_world);
  return NumMatches(options_, *tracked.frame, visible.points.size(), visible.lines.size()) <
         options_.min_matches;
}

PoseFit Tracker::TrackLastFrame(const Map& map, const Rigid3& prediction, double radius,
                                TrackedFrame* tracked) const {
  Stopwatch stopwatch;
  const LocalMap candidates = CandidatesFromFrame(map, last_, CamFromWorld(map, last_), prediction);
  tracked->cam_from_world = prediction;
  tracked->matches = MatchLocalMap(options_, *tracked->frame, candidates, radius, {});
  tracked->times.matching += stopwatch.Milliseconds();
  if (!EstimatePose(initial_pose_, map, tracked)) return PoseFit::kNone;
  return FitOf(*tracked, candidates);
}

// The map around the pose of the pose factors, or else the neighbourhood of the reference keyframe.
bool Tracker::TrackMapAround(const Map& map, const Prediction& prediction,
                             TrackedFrame* tracked) const {
  Stopwatch stopwatch;
  const Rigid3& pose = prediction.cam_from_world;
  const LocalMap local =
      prediction.by_factors.usable
          ? SelectVisibleLandmarks(map, *tracked->frame, pose)
          : SelectLocalMap(map, *tracked->frame, pose, {}, ReferenceOrNewest(map, last_.reference),
                           options_.max_local_keyframes);
  tracked->cam_from_world = pose;
  tracked->matches = MatchLocalMap(options_, *tracked->frame, local, options_.wide_radius, {});
  tracked->times.matching += stopwatch.Milliseconds();
  return EstimatePose(initial_pose_, map, tracked);
}

bool Tracker::Relocalize(const Map& map, TrackedFrame* tracked) {
  const int num_keyframes = NumKeyframesToTry(map, tracked->frame->timestamp);
  for (int i = 0; i < num_keyframes; ++i) {
    // From newest to oldest, a few keyframes per frame, cyclically.
    const auto* keyframe = map.keyframes().FindUpTo(next_candidate_);
    if (keyframe == nullptr) keyframe = &map.keyframes().back();
    next_candidate_ = keyframe->first - 1;
    Stopwatch stopwatch;
    const std::optional<Relocalization> hit = msc_vo::Relocalize(
        options_.relocalizer, options_.line_matcher, *tracked->frame, map, keyframe->second);
    tracked->times.matching += stopwatch.Milliseconds();
    if (!hit) continue;
    tracked->cam_from_world = hit->cam_from_world;
    tracked->matches = hit->matches;
    if (EstimatePose(initial_pose_, map, tracked)) {
      next_candidate_ = kNoId;
      tracked->relocalized = true;
      return true;
    }
  }
  return false;
}

bool Tracker::TrackLocalMap(const Map& map, TrackedFrame* tracked) const {
  Stopwatch stopwatch;
  const PoseSummary initial_pose = tracked->pose;
  const FrameMatches initial_matches = tracked->matches;
  const LocalMap local =
      SelectLocalMap(map, *tracked->frame, tracked->cam_from_world, tracked->matches,
                     ReferenceOrNewest(map, last_.reference), options_.max_local_keyframes);
  tracked->matches = MatchLocalMap(options_, *tracked->frame, local, options_.local_map_radius,
                                   LandmarkInliers(tracked->matches));
  PerKind<std::vector<LandmarkId>>& visible = tracked->keyframe.visible;
  for (const PointCandidate& point : local.points) visible.points.push_back(point.id);
  for (const LineCandidate& line : local.lines) visible.lines.push_back(line.id);
  tracked->times.matching += stopwatch.Milliseconds();
  const bool found = EstimatePose(options_.pose, map, tracked);
  if (!found) {
    // The local map has too few landmarks here: the initial pose holds.
    tracked->pose = initial_pose;
    tracked->matches = initial_matches;
  }
  tracked->matches = LandmarkInliers(tracked->matches);
  SetReference(map, local.reference, tracked);
  return found;
}

bool Tracker::UpdatePlausibility(const Map& map, const TrackedFrame& tracked,
                                 const Rigid3& last_from_world, const Prediction& prediction) {
  const double timestamp = tracked.frame->timestamp;
  const double seconds = timestamp - last_.frame->timestamp;
  const Rigid3 cam_from_last = tracked.cam_from_world * last_from_world.Inverse();
  // Pose factors measure the motion where images do not.
  const bool is_measured = prediction.by_factors.usable;
  const bool after_gap = (tracked.relocalized || in_gap_) && !is_measured;
  const PoseOrigin origin = after_gap                          ? PoseOrigin::kAfterGap
                            : tracked.searched && !is_measured ? PoseOrigin::kSearch
                                                               : PoseOrigin::kPrediction;
  plausibility_.Observe(timestamp, CameraVelocity::Of(cam_from_last, seconds), origin);
  if (after_gap && (tracked.status == TrackingStatus::kWeak || ContradictsDepth(tracked, map))) {
    plausibility_.MarkImplausible(timestamp);
  }
  return !plausibility_.IsImplausible(timestamp);
}

bool Tracker::EstimatePose(const PoseOptions& options, const Map& map,
                           TrackedFrame* tracked) const {
  if (NumMatches(options_, *tracked->frame, tracked->matches.points.size(),
                 tracked->matches.lines.size()) < options_.min_matches) {
    return false;
  }
  Stopwatch stopwatch;
  const Rigid3 start = tracked->cam_from_world;
  tracked->pose = EstimateFramePose(options, *tracked->frame, map, tracked->noise_scale,
                                    pose_factors_, &tracked->cam_from_world, &tracked->matches);
  tracked->times.pose += stopwatch.Milliseconds();
  const bool good = HasEnoughInliers(options_, *tracked);
  if (!good) {
    tracked->cam_from_world = start;
  } else if (tracked->pose.num_dynamic > tracked->num_dynamic) {
    tracked->num_dynamic = tracked->pose.num_dynamic;
    tracked->dynamic_cells = tracked->pose.dynamic_cells;
  }
  return good;
}

void Tracker::ProposeKeyframe(const MapSnapshot& snapshot, TrackedFrame* tracked) {
  // The second frame yields the velocity of the first keyframe, which is compensated with it.
  const Keyframe& newest = snapshot.map.keyframes().back().second;
  const bool is_second = last_.frame->timestamp == newest.frame->timestamp;
  const bool enables_compensation =
      snapshot.readout_time != 0.0 && AwaitsCompensation(snapshot) && is_second;
  Stopwatch stopwatch;
  tracked->in_inactive_map = inactive_map_search_.Search(
      *tracked, snapshot, SecondsSincePrevious(tracked->frame->timestamp));
  tracked->times.matching += stopwatch.Milliseconds();
  tracked->keyframe.is_due = policy_.IsDue(*tracked->frame, tracked->matches,
                                           tracked->status == TrackingStatus::kTracked) ||
                             enables_compensation || tracked->in_inactive_map.has_value();
  if (!tracked->keyframe.is_due) return;
  policy_.Inserted(tracked->frame->timestamp);
  tracked->frame = MarkDynamicFeatures(options_.pose.consensus, snapshot.map, *tracked);
}

void Tracker::UpdateMotion(const Rigid3& last_from_world, TrackedFrame* tracked) {
  const double timestamp = tracked->frame->timestamp;
  if (timestamp - last_.frame->timestamp > options_.max_prediction) {
    motion_.Reset(timestamp);
    return;
  }
  const Rigid3 cam_from_last = tracked->cam_from_world * last_from_world.Inverse();
  if (last_.keyframe.is_due) {
    tracked->keyframe.previous_velocity = motion_.LastVelocity(timestamp, cam_from_last);
  }
  motion_.Observe(timestamp, cam_from_last);
}

}  // namespace msc_vo
