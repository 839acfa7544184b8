// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/benchmarks/loop_world.h"

#include <algorithm>

#include "apps/benchmarks/rendered_images.h"
#include "msc_vo/geometry/angles.h"
#include "msc_vo/geometry/so3.h"

namespace msc_vo {

namespace {

constexpr int kMostImages = 400;
constexpr int kViewStep = 5;       // images per view in which returns are searched: half a second
constexpr int kMinOldPoints = 10;  // of an earlier visit, by which a frame is back

bool IsFalse(const LoopWorld& world, const ClaimedPlace& claim) {
  const int older = static_cast<int>(claim.older), newer = static_cast<int>(claim.newer);
  const SyntheticSequence& sequence = world.sequence();
  if (OverlapOf(sequence.SurfacesAt(newer), sequence.SurfacesAt(older)) == 0.0) return true;
  if (!claim.older_from_newer) return false;
  const Rigid3 truth =
      sequence.PoseAt(older).world_from_cam.Inverse() * sequence.PoseAt(newer).world_from_cam;
  const Rigid3 error = truth.Inverse() * *claim.older_from_newer;
  return error.translation().norm() > 0.5 ||
         LogSO3(error.rotation()).norm() > DegreesToRadians(15.0);
}

}  // namespace

SceneKind LookAlikeKind(int index) {
  constexpr SceneKind kKinds[] = {SceneKind::kRooms, SceneKind::kMirrored, SceneKind::kFloors,
                                  SceneKind::kDesks};
  return kKinds[index % 4];
}

LoopWorld::LoopWorld(const LoopWorldOptions& options)
    : scene_(options.scene),
      sequence_(QuickWalk(options.scene, options.seed, {options.path, options.returns})),
      num_images_(std::min(kMostImages, sequence_.WalkLength().value_or(kMostImages))) {}

const std::string& LoopWorld::name() const { return SceneKindNames()[static_cast<int>(scene_)]; }

RgbdImage LoopWorld::Render(int index) const { return RenderImage(sequence_, index); }

std::vector<TimedPose> LoopWorld::TruePoses() const {
  std::vector<TimedPose> poses;
  for (int i = 0; i < num_images_; ++i) poses.push_back(sequence_.PoseAt(i));
  return poses;
}

std::vector<ClaimedPlace> ClaimsOf(const OdometryResult& result) {
  std::vector<ClaimedPlace> claims;
  for (const Loop& loop : result.loops) {
    if (loop.reference < 0) continue;
    const FrameResult& older = result.frames[loop.reference];
    const FrameResult& newer = result.frames[loop.frame];
    claims.push_back({older.id, newer.id, older.cam_from_world * newer.cam_from_world.Inverse()});
  }
  return claims;
}

std::vector<int64_t> OriginsOf(const TrackedImage& tracked) {
  const Map& map = tracked.map.map;
  std::vector<int64_t> origins;
  for (const auto& match : tracked.tracked.matches.points) {
    const PointLandmark* point = map.Find<PointLandmark>(match.id);
    if (point == nullptr) continue;
    origins.push_back(map.FindKeyframe(point->observations.front().keyframe)->frame->id);
  }
  return origins;
}

LoopScore ScoreClaims(const LoopWorld& world, const std::vector<ClaimedPlace>& claims,
                      const PointOrigins& origins) {
  std::vector<SurfaceView> views;
  for (int i = 0; i < world.num_images(); i += kViewStep) {
    views.push_back(world.sequence().SurfacesAt(i));
  }
  const std::vector<TrueReturn> returns = FindReturns(views);
  std::vector<bool> is_found(returns.size(), false);
  LoopScore score;
  score.num_returns = static_cast<int>(returns.size());
  for (const ClaimedPlace& claim : claims) {
    ++score.num_claims;
    if (IsFalse(world, claim)) {
      ++score.num_false;
      continue;
    }
    for (size_t i = 0; i < returns.size(); ++i) {
      const int first = (returns[i].first - 1) * kViewStep;
      const int end = (returns[i].last + 1) * kViewStep;
      if (claim.newer > first && claim.newer < end) is_found[i] = true;
    }
  }
  for (size_t i = 0; i < returns.size(); ++i) {
    const int64_t between = kViewStep * (returns[i].earlier + returns[i].first) / 2;
    const int end = std::min<int>(kViewStep * returns[i].last + 1, origins.size());
    for (int frame = kViewStep * returns[i].first; frame < end; ++frame) {
      const auto num_old = std::count_if(origins[frame].begin(), origins[frame].end(),
                                         [between](int64_t id) { return id < between; });
      if (num_old >= kMinOldPoints) is_found[i] = true;
    }
  }
  score.num_found = static_cast<int>(std::count(is_found.begin(), is_found.end(), true));
  return score;
}

}  // namespace msc_vo
