// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/tracking/tracker.h"

#include <utility>

#include "msc_vo/frame/feature_counts.h"
#include "msc_vo/matching/local_map.h"
#include "msc_vo/matching/plane_matcher.h"
#include "msc_vo/pose_estimation/plane_factors.h"
#include "msc_vo/tracking/dynamic_features.h"
#include "msc_vo/tracking/frame_compensation.h"
#include "msc_vo/tracking/plane_pose.h"
#include "msc_vo/tracking/pose_support.h"

namespace msc_vo {

namespace {

void SetPose(const Map& map, const Rigid3& cam_from_world, KeyframeId reference,
             TrackedFrame* tracked) {
  tracked->cam_from_world = cam_from_world;
  tracked->reference = reference;
  tracked->cam_from_reference = cam_from_world * map.CamFromWorld(reference).Inverse();
}

// The summary of the last pose optimisation, with the dynamic objects of the one that found most.
PoseSummary WithDynamicObjects(PoseSummary last, const PoseSummary& first) {
  if (first.num_dynamic >= last.num_dynamic) {
    last.num_dynamic = first.num_dynamic;
    last.dynamic_cells = first.dynamic_cells;
  }
  return last;
}

}  // namespace

Tracker::Tracker(const TrackerOptions& options)
    : options_(options),
      policy_(options.keyframes),
      places_(options),
      segment_start_(options.segments) {}

TrackedFrame Tracker::Track(const std::shared_ptr<const Frame>& raw, const MapSnapshot& snapshot) {
  // Before the last evaluation of the factors, nothing else changes that later frames depend on.
  const TryOrder relocalization = relocalization_;
  try {
    return TrackFrame(raw, snapshot, pose_factor_callback_ != nullptr);
  } catch (...) {
    relocalization_ = relocalization;
    throw;
  }
}

TrackedFrame Tracker::TrackFrame(const std::shared_ptr<const Frame>& raw,
                                 const MapSnapshot& snapshot, bool use_factors) {
  if (snapshot.map.keyframes().empty()) return Initialize(raw);
  const Input input = Predict(raw, snapshot, use_factors);
  PoseEstimator estimator(options_, snapshot.map, snapshot.noise_scale, pose_factors_);
  places_.Update(snapshot);
  const auto keyframes_to_try = [&] {
    return places_.SelectKeyframes(*input.frame, snapshot.map,
                                   NumKeyframesToTry(snapshot.map, raw->timestamp),
                                   &relocalization_);
  };
  const std::optional<InitialPose> initial = FindInitialPose(
      options_, *input.frame, last_, input.prediction, keyframes_to_try, &estimator);
  TrackedFrame tracked = initial ? TrackInMap(input, *initial, &estimator) : TrackInGap(input);
  tracked.has_pose_factors = !pose_factors_.empty();
  tracked.times = estimator.times();
  return tracked;
}

TrackedFrame Tracker::TrackInMap(const Input& input, const InitialPose& initial,
                                 PoseEstimator* estimator) {
  const bool is_in_map = IsInMap(input, initial.pose);
  if (!is_in_map && !input.snapshot.calibration_is_doubted) {
    // Blank walls have false corners, which show a motion of their own.
    if (std::optional<TrackedFrame> tracked = TrackByPlanes(input, PlanesSpan::kSpace)) {
      return *tracked;
    }
  }
  TrackedFrame tracked = TrackLocalMap(input, initial.pose, is_in_map, estimator);
  tracked.relocalized = initial.origin == PoseOrigin::kAfterGap;
  ConfirmStatus(input, initial.origin, &tracked);
  tracked.keyframe = ProposeKeyframe(input, tracked, estimator);
  if (tracked.keyframe.is_due()) {
    tracked.frame = MarkDynamicFeatures(options_.pose.consensus, input.snapshot.map, tracked);
  }
  in_gap_ = false;
  relocalization_.Reset();
  segment_start_.Tracked(tracked.frame->timestamp);
  Follow(&tracked);
  AddJumpCovariance(input, &tracked);
  return tracked;
}

TrackedFrame Tracker::TrackInGap(const Input& input) {
  if (std::optional<TrackedFrame> tracked = TrackByPlanes(input, PlanesSpan::kAny)) return *tracked;
  const Map& map = input.snapshot.map;
  in_gap_ = true;
  TrackedFrame tracked = BridgeWithPrediction(input);
  if (IsNewSegmentDue(map, tracked)) return BeginSegment(input);
  if (IsOutsideMappedArea(map, tracked)) {
    tracked.keyframe.id = MakeKeyframe(tracked.frame->timestamp);
    Follow(&tracked);
  }
  return tracked;
}

// After a gap, a prediction does not tell parallel planes apart.
std::optional<TrackedFrame> Tracker::TrackByPlanes(const Input& input, PlanesSpan span) {
  const double timestamp = input.frame->timestamp;
  if (in_gap_ || timestamp - last_.frame->timestamp > options_.max_prediction) return std::nullopt;
  const auto estimate = [&, expected = ExpectPoseOf(input)](const Frame& frame) {
    return EstimateByPlanes(options_, frame, input.snapshot, expected, pose_factors_);
  };
  std::optional<PlanePose> pose = estimate(*input.frame);
  if (!pose || (span == PlanesSpan::kSpace && !pose->is_determined)) return std::nullopt;
  TrackedFrame tracked;
  tracked.frame = CompensateAgain(input, pose->cam_from_world);
  pose = estimate(*tracked.frame);
  if (!pose) return std::nullopt;
  if (!pose->is_determined) HoldByLandmarks(input, &*pose, &tracked);
  tracked.pose = pose->summary;
  tracked.planes = pose->planes;
  SetPose(input.snapshot.map, pose->cam_from_world,
          ReferenceOrNewest(input.snapshot.map, last_.reference), &tracked);
  tracked.cam_from_last = tracked.cam_from_world * input.last_from_world.Inverse();
  // In directions that the planes leave free, the sigma (ExpectedPose::free) begins small.
  tracked.status =
      pose->is_determined ? ClassifyStatus(options_, tracked.pose) : TrackingStatus::kWeak;
  const bool is_certain =
      tracked.status == TrackingStatus::kTracked && !plausibility_.IsImplausible(timestamp);
  if (is_certain && policy_.IsDue(*input.frame, tracked.matches, is_certain)) {
    tracked.keyframe.id = MakeKeyframe(timestamp);
  }
  if (pose->is_determined) relocalization_.Reset();
  segment_start_.Tracked(timestamp);
  Follow(&tracked);
  AddJumpCovariance(input, &tracked);
  return tracked;
}

void Tracker::HoldByLandmarks(const Input& input, PlanePose* pose, TrackedFrame* tracked) const {
  const Map& map = input.snapshot.map;
  const LocalMap local =
      SelectLocalMap(map, *tracked->frame, pose->cam_from_world, {},
                     ReferenceOrNewest(map, last_.reference), options_.max_local_keyframes);
  if (!msc_vo::HoldByLandmarks(options_, *tracked->frame, input.snapshot, local,
                               ExpectPoseOf(input), pose_factors_, pose)) {
    return;
  }
  tracked->matches = pose->landmarks;
  tracked->visible = IdsOf(local);
}

std::shared_ptr<const Frame> Tracker::CompensateAgain(const Input& input,
                                                      const Rigid3& cam_from_world) const {
  const Rigid3 cam_from_last = cam_from_world * input.last_from_world.Inverse();
  return CompensateFrame(input.raw, motion_.VelocitySince(input.raw->timestamp, cam_from_last),
                         CompensationReadoutTime(input.snapshot));
}

ExpectedPose Tracker::ExpectPoseOf(const Input& input) const {
  const PosePrediction& prediction = input.prediction;
  if (prediction.by_factors.usable) {
    return {prediction.cam_from_world, prediction.by_factors.covariance, std::nullopt};
  }
  // Behind a frame that was not determined, the velocity is that of noise.
  std::optional<Rigid3> velocity;
  if (last_determined_ == last_.frame->timestamp) {
    velocity = prediction.cam_from_world * input.last_from_world.Inverse();
  }
  const double timestamp = input.frame->timestamp;
  return ExpectPose(input.last_from_world,
                    CovarianceOfCamera(input.last_from_world, last_covariance_),
                    timestamp - last_.frame->timestamp, velocity, timestamp - last_determined_);
}

TrackedFrame Tracker::Initialize(const std::shared_ptr<const Frame>& frame) {
  TrackedFrame tracked;
  tracked.frame = frame;
  // An image without any feature is that of a covered camera.
  const bool shows_planes = DetermineAPose(frame->planes) && Sum(SizesOf(*frame)) > 0;
  if (CanBeginMap(*frame, options_.min_initial_features) || shows_planes) {
    StartSegment(SegmentStart::kFirst, &tracked);
  }
  return tracked;
}

// The map of the segment begins where the camera was seen last. That is no measurement, but keeps
// the trajectory continuous.
TrackedFrame Tracker::BeginSegment(const Input& input) {
  TrackedFrame tracked;
  tracked.frame = input.raw;
  tracked.cam_from_world = input.last_from_world;
  tracked.cam_from_reference = input.last_from_world;
  tracked.keyframe.last_tracked = {last_.frame->timestamp, last_.reference,
                                   last_.cam_from_reference};
  StartSegment(segment_start_.is_confirmed() ? SegmentStart::kAfterLoss : SegmentStart::kReplacing,
               &tracked);
  return tracked;
}

void Tracker::StartSegment(SegmentStart start, TrackedFrame* tracked) {
  const double timestamp = tracked->frame->timestamp;
  tracked->status = TrackingStatus::kTracked;
  tracked->keyframe.segment_start = start;
  tracked->keyframe.id = MakeKeyframe(timestamp);
  motion_.Reset(timestamp);
  last_determined_ = timestamp;
  last_covariance_.setZero();
  plausibility_ = PosePlausibility();
  in_gap_ = false;
  segment_start_.Started(timestamp);
  relocalization_.Reset();
  last_ = LastFrame(*tracked);
}

Tracker::Input Tracker::Predict(const std::shared_ptr<const Frame>& raw,
                                const MapSnapshot& snapshot, bool use_factors) {
  last_.UpdateTo(snapshot);
  const double timestamp = raw->timestamp;
  const double readout_time = CompensationReadoutTime(snapshot);
  Input input{snapshot, raw, raw, last_.CamFromWorld(snapshot.map), {}};
  if (readout_time != 0.0) {
    input.frame = CompensateFrame(raw, motion_.VelocityAt(timestamp), readout_time);
  }
  Rigid3& predicted = input.prediction.cam_from_world;
  predicted = motion_.Predict(timestamp) * input.last_from_world;
  pose_factors_.clear();
  if (use_factors) {
    pose_factors_ = pose_factor_callback_({timestamp, last_.frame->timestamp, input.last_from_world,
                                           predicted, snapshot.world, snapshot.extra_blocks});
  }
  if (pose_factors_.empty()) return input;
  FrameMatches none;
  input.prediction.by_factors =
      EstimateFramePose(options_.pose, *input.frame, snapshot.map, snapshot.noise_scale,
                        pose_factors_, &predicted, &none);
  return input;
}

TrackedFrame Tracker::BridgeWithPrediction(const Input& input) const {
  const PosePrediction& prediction = input.prediction;
  const double gap = input.frame->timestamp - last_.frame->timestamp;
  const bool is_known = prediction.by_factors.usable || gap <= options_.max_prediction;
  TrackedFrame tracked;
  tracked.frame = input.frame;
  tracked.status = is_known ? TrackingStatus::kPredicted : TrackingStatus::kLost;
  tracked.pose = prediction.by_factors;
  const Map& map = input.snapshot.map;
  SetPose(map, prediction.cam_from_world, ReferenceOrNewest(map, last_.reference), &tracked);
  tracked.cam_from_last = tracked.cam_from_world * input.last_from_world.Inverse();
  return tracked;
}

bool Tracker::IsNewSegmentDue(const Map& map, const TrackedFrame& tracked) {
  const double timestamp = tracked.frame->timestamp;
  if (tracked.pose.usable) {
    segment_start_.Tracked(timestamp);  // by pose factors, which keep the camera in the map
    return false;
  }
  const bool could_begin = CanBeginMap(*tracked.frame, options_.min_initial_features);
  segment_start_.NotFound(timestamp, could_begin, NumKeyframesToTry(map, timestamp));
  return could_begin && tracked.status == TrackingStatus::kLost &&
         segment_start_.IsDue(static_cast<int>(map.keyframes().size()));
}

bool Tracker::IsOutsideMappedArea(const Map& map, const TrackedFrame& tracked) const {
  const Frame& frame = *tracked.frame;
  if (!tracked.pose.usable || !CanBeginMap(frame, options_.min_initial_features)) return false;
  const LocalMap visible = SelectVisibleLandmarks(map, frame, tracked.cam_from_world);
  return NumMatches(options_, frame, SizesOf(visible)) < options_.min_matches;
}

TrackedFrame Tracker::TrackLocalMap(const Input& input, const FramePose& initial, bool is_in_map,
                                    PoseEstimator* estimator) const {
  const Map& map = input.snapshot.map;
  TrackedFrame tracked;
  tracked.frame = CompensateAgain(input, initial.cam_from_world);
  const LocalMap local = estimator->Search([&] {
    return SelectLocalMap(map, *tracked.frame, initial.cam_from_world, initial.matches,
                          ReferenceOrNewest(map, last_.reference), options_.max_local_keyframes);
  });
  const PlanePosePrior prior = PriorOf(input, initial, is_in_map);
  const PoseCovariance covariance =
      initial.summary.covariance + CovarianceOfCamera(initial.cam_from_world, prior.correctable);
  if (!input.snapshot.calibration_is_doubted) {
    tracked.planes =
        MatchPlanes(tracked.frame->planes, input.snapshot.planes, initial.cam_from_world,
                    CovarianceForMatching(initial.cam_from_world, covariance));
  }
  estimator->AddFactors(MakePlanePoseFactors(tracked.frame->planes, tracked.planes,
                                             input.snapshot.planes, PlanesBeside::kPointsAndLines));
  std::optional<FramePose> pose =
      estimator->MatchAndEstimate(options_.pose, *tracked.frame, local, options_.local_map_radius,
                                  initial.cam_from_world, LandmarkInliers(initial.matches));
  bool is_known = pose.has_value();
  if (!pose) {
    pose = initial;
    pose->summary.covariance = covariance;
    is_known =
        CorrectByPlanes(options_, *tracked.frame, tracked.planes, input.snapshot, prior, &*pose) &&
        DetermineAPose(*tracked.frame, tracked.planes);
  }
  tracked.status = is_known ? ClassifyStatus(options_, pose->summary) : TrackingStatus::kWeak;
  tracked.pose = WithDynamicObjects(pose->summary, initial.summary);
  tracked.matches = LandmarkInliers(pose->matches);
  tracked.visible = IdsOf(local);
  SetPose(map, pose->cam_from_world, local.reference, &tracked);
  tracked.cam_from_last = tracked.cam_from_world * input.last_from_world.Inverse();
  return tracked;
}

bool Tracker::IsInMap(const Input& input, const FramePose& initial) const {
  const PerKind<int> num_landmarks = CountLandmarkInliers(initial.matches);
  return input.prediction.by_factors.usable ||
         NumMatches(options_, *input.frame, num_landmarks) >= options_.min_matches;
}

PlanePosePrior Tracker::PriorOf(const Input& input, const FramePose& initial,
                                bool is_in_map) const {
  const Rigid3& cam_from_world = initial.cam_from_world;
  PlanePosePrior prior{cam_from_world,
                       CameraCovariance(cam_from_world, initial.summary.covariance)};
  if (is_in_map) return prior;
  const Rigid3 cam_from_last = cam_from_world * input.last_from_world.Inverse();
  prior.correctable = TransportCovariance(cam_from_last, last_covariance_);
  return prior;
}

void Tracker::ConfirmStatus(const Input& input, PoseOrigin origin, TrackedFrame* tracked) {
  const double timestamp = tracked->frame->timestamp;
  const double seconds = timestamp - last_.frame->timestamp;
  if (in_gap_) origin = PoseOrigin::kAfterGap;
  // Pose factors measure the motion where images do not.
  if (input.prediction.by_factors.usable) origin = PoseOrigin::kPrediction;
  plausibility_.Observe(timestamp, CameraVelocity::Of(*tracked->cam_from_last, seconds), origin);
  if (origin == PoseOrigin::kAfterGap && (tracked->status == TrackingStatus::kWeak ||
                                          ContradictsDepth(*tracked, input.snapshot.map))) {
    plausibility_.MarkImplausible(timestamp);
  }
  tracked->is_implausible = plausibility_.IsImplausible(timestamp);
  tracked->is_jump = plausibility_.is_marked();
  if (tracked->is_implausible) tracked->status = TrackingStatus::kWeak;
}

void Tracker::AddJumpCovariance(const Input& input, TrackedFrame* tracked) {
  const Rigid3& cam_from_world = tracked->cam_from_world;
  const PoseCovariance& of_jump = plausibility_.UpdateJumpCovariance(
      tracked->frame->timestamp, *tracked->cam_from_last,
      cam_from_world * input.prediction.cam_from_world.Inverse());
  tracked->pose.covariance += CovarianceOfCamera(cam_from_world, of_jump);
}

KeyframeProposal Tracker::ProposeKeyframe(const Input& input, const TrackedFrame& tracked,
                                          PoseEstimator* estimator) {
  const MapSnapshot& snapshot = input.snapshot;
  const double timestamp = tracked.frame->timestamp;
  // The second frame yields the velocity of the first keyframe, which is compensated with it.
  const bool enables_compensation = snapshot.readout_time != 0.0 && AwaitsCompensation(snapshot) &&
                                    last_.keyframe == snapshot.newest_keyframe;
  const bool is_certain = tracked.status == TrackingStatus::kTracked;
  const bool is_useful = policy_.IsDue(*tracked.frame, tracked.matches, is_certain);
  // A keyframe at a pose that may be of another place would join the two in the map.
  const bool is_due = (is_useful || enables_compensation) && !tracked.is_implausible;
  KeyframeProposal proposal;
  proposal.revisit = estimator->Search([&] {
    return places_.FindRevisit(tracked, is_due, snapshot, SecondsSincePrevious(timestamp));
  });
  if (is_due || proposal.revisit) proposal.id = MakeKeyframe(timestamp);
  return proposal;
}

KeyframeId Tracker::MakeKeyframe(double timestamp) {
  policy_.Inserted(timestamp);
  return next_keyframe_++;
}

void Tracker::Follow(TrackedFrame* tracked) {
  const double timestamp = tracked->frame->timestamp;
  if (tracked->status == TrackingStatus::kTracked) last_determined_ = timestamp;
  if (timestamp - last_.frame->timestamp > options_.max_prediction) {
    motion_.Reset(timestamp);
  } else {
    if (last_.keyframe != kNoId) {
      tracked->previous_velocity = motion_.LastVelocity(timestamp, *tracked->cam_from_last);
    }
    motion_.Observe(timestamp, *tracked->cam_from_last);
  }
  last_ = LastFrame(*tracked);
  last_covariance_ = CameraCovariance(tracked->cam_from_world, tracked->pose.covariance);
}

}  // namespace msc_vo
