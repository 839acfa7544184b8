// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/odometry/pose_refiner.h"

#include <utility>

#include "msc_vo/frame/frame_intrinsics.h"
#include "msc_vo/pose_estimation/plane_factors.h"
#include "msc_vo/self_calibration/keyframe_frames.h"
#include "msc_vo/tracking/frame_pose.h"
#include "msc_vo/tracking/tracked_frame.h"

namespace msc_vo {

namespace {

// Fewest observations that a pose is estimated from; a line counts as two points.
constexpr int kMinObservations = 15;
// Most poses that are estimated at once, after a pause.
constexpr int kMaxFrames = 3;

// The inliers are known, so that one round with the robust loss and one without it are enough.
PoseOptions WithTwoRounds(PoseOptions options) {
  options.num_rounds = 2;
  options.num_robust_rounds = 1;
  options.consensus.enabled = false;
  return options;
}

// The landmarks that are still in the map, where they are now.
FrameMatches MatchesWith(const Map& map, const PerKind<std::vector<LandmarkId>>& landmarks) {
  FrameMatches matches;
  ForEachLandmarkKind([&](auto kind) {
    using L = typename decltype(kind)::Landmark;
    const std::vector<LandmarkId>& ids = landmarks.Of<L>();
    for (size_t i = 0; i < ids.size(); ++i) {
      const L* landmark = map.Find<L>(ids[i]);
      if (landmark == nullptr) continue;
      OfKind<L>(matches).push_back({static_cast<int>(i), ids[i], landmark->geometry()});
    }
  });
  return matches;
}

}  // namespace

PoseRefiner::PoseRefiner(const PoseOptions& options, double delay)
    : options_(WithTwoRounds(options)), delay_(delay) {}

void PoseRefiner::Add(int index, const TrackedFrame& tracked, const MapSnapshot& snapshot) {
  if (delay_ == 0.0 || tracked.reference == kNoId || tracked.keyframe.is_due() ||
      tracked.has_pose_factors) {
    return;
  }
  if (Support(SizesOf(tracked.matches)) < kMinObservations) return;
  PendingFrame pending;
  pending.index = index;
  pending.reference = tracked.reference;
  pending.world = snapshot.world;
  pending.plane_numbering = snapshot.planes.numbering;
  auto frame = std::make_shared<Frame>();
  frame->id = tracked.frame->id;
  frame->timestamp = tracked.frame->timestamp;
  frame->camera = tracked.frame->camera;
  frame->lens = tracked.frame->lens;
  frame->intrinsics = tracked.frame->intrinsics;
  frame->velocity = tracked.frame->velocity;
  frame->readout_time = tracked.frame->readout_time;
  ForEachLandmarkKind([&](auto kind) {
    using L = typename decltype(kind)::Landmark;
    const auto& matches = OfKind<L>(tracked.matches);
    OfKind<L>(*frame).reserve(matches.size());
    pending.landmarks.Of<L>().reserve(matches.size());
    for (const auto& match : matches) {
      OfKind<L>(*frame).push_back(FeaturesOf<L>(*tracked.frame)[match.feature]);
      pending.landmarks.Of<L>().push_back(match.id);
    }
  });
  for (const PlaneMatch& match : tracked.planes) {
    pending.planes.push_back({static_cast<int>(frame->planes.size()), match.plane});
    frame->planes.push_back(tracked.frame->planes[match.feature]);
  }
  pending.frame = std::move(frame);
  frames_.push_back(std::move(pending));
}

void PoseRefiner::Refine(double timestamp, const MapSnapshot& snapshot,
                         std::vector<ReferencedPose>* poses) {
  for (int i = 0; i < kMaxFrames && !frames_.empty(); ++i) {
    if (frames_.front().frame->timestamp >= timestamp - delay_) return;
    RefineFrame(frames_.front(), snapshot, &(*poses)[frames_.front().index]);
    frames_.pop_front();
  }
}

void PoseRefiner::RefineAll(const MapSnapshot& snapshot, std::vector<ReferencedPose>* poses) const {
  for (const PendingFrame& pending : frames_) {
    RefineFrame(pending, snapshot, &(*poses)[pending.index]);
  }
}

// Whether the planes that the frame observes are those of the snapshot, and may be used.
bool PoseRefiner::HasPlanes(const PendingFrame& pending, const Frame& frame,
                            const MapSnapshot& snapshot) {
  return !frame.planes.empty() && !snapshot.calibration_is_doubted &&
         pending.world == snapshot.world && pending.plane_numbering == snapshot.planes.numbering;
}

// Number of observations of which half must fit another pose: all of the frame, or those whose
// landmarks are left if its depth was not registered. Many landmarks of such a map are not.
int PoseRefiner::NumExpected(const PendingFrame& pending, const Frame& frame,
                             const FrameMatches& matches) {
  const bool is_same = pending.frame->intrinsics == frame.intrinsics ||
                       HasSameRegistration(*pending.frame->intrinsics, *frame.intrinsics);
  return Sum(is_same ? SizesOf(pending.landmarks) : SizesOf(matches));
}

void PoseRefiner::RefineFrame(const PendingFrame& pending, const MapSnapshot& snapshot,
                              ReferencedPose* pose) const {
  const Map* map = snapshot.FindMapOf(pending.reference);
  // Another reference: the segment of the frame was discarded.
  if (map == nullptr || pose->reference != pending.reference) return;
  const std::shared_ptr<const Frame> frame = ChangeIntrinsics(
      UpdateCompensation(pending.frame, snapshot.readout_time), snapshot.intrinsics);
  FrameMatches matches = MatchesWith(*map, pending.landmarks);
  if (Support(SizesOf(matches)) < kMinObservations) return;
  const int num_expected = NumExpected(pending, *frame, matches);
  const Rigid3 reference_from_world = map->CamFromWorld(pose->reference);
  Rigid3 cam_from_world = pose->cam_from_reference * reference_from_world;
  std::vector<PoseFactor> by_planes;
  if (HasPlanes(pending, *frame, snapshot)) {
    by_planes = MakePlanePoseFactors(frame->planes, pending.planes, snapshot.planes,
                                     PlanesBeside::kPointsAndLines);
  }
  const PoseSummary summary = EstimateFramePose(options_, *frame, *map, snapshot.noise_scale,
                                                by_planes, &cam_from_world, &matches);
  if (!summary.usable || 2 * Sum(summary.num_inliers) < num_expected) return;
  pose->cam_from_reference = cam_from_world * reference_from_world.Inverse();
}

}  // namespace msc_vo
