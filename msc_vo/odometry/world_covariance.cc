// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/odometry/world_covariance.h"

#include <map>

#include "msc_vo/mapping/keyframe_graph.h"
#include "msc_vo/tracking/tracked_frame.h"

namespace msc_vo {

namespace {

PathCovariances FromOrigin(const Map& map, const std::vector<PoseGraphEdge>& loops) {
  return {map, loops, map.KnownKeyframes().front()};
}

// Of a camera, relative to the origin, in its own frame. `camera`: relative to the map nearby. The
// landmarks there err together, relative to the reference keyframe. That is all there is if this
// keyframe is the origin.
PoseCovariance WithDrift(const PathCovariances& keyframes, const ReferencedPose& pose,
                         const PoseCovariance& camera) {
  return camera + keyframes.Of(pose.reference, pose.cam_from_reference, CommonViewCovariance());
}

}  // namespace

void WorldCovariance::Set(const TrackedFrame& tracked, const MapSnapshotPtr& map,
                          FrameResult* result) {
  if (!result->covariance || tracked.reference == kNoId) return;
  if (map_ != map) keyframes_ = FromOrigin(map->map, map->loops);
  map_ = map;
  result->world_covariance = CovarianceOfCamera(
      result->cam_from_world,
      WithDrift(*keyframes_, {tracked.reference, tracked.cam_from_reference},
                CameraCovariance(tracked.cam_from_world, tracked.pose.covariance)));
}

void SetWorldCovariances(const Mapper& mapper, const std::vector<ReferencedPose>& poses,
                         std::vector<FrameResult>* frames) {
  std::map<const SubMap*, PathCovariances> keyframes;
  for (size_t i = 0; i < frames->size(); ++i) {
    FrameResult& frame = (*frames)[i];
    frame.world_covariance.reset();
    const SubMap* submap =
        poses[i].reference != kNoId ? mapper.atlas().FindSubMapOf(poses[i].reference) : nullptr;
    if (!frame.covariance || submap == nullptr) continue;
    auto place = keyframes.find(submap);
    if (place == keyframes.end()) {
      place = keyframes.emplace(submap, FromOrigin(submap->map, mapper.loop_edges())).first;
    }
    frame.world_covariance = CovarianceOfCamera(
        frame.cam_from_world, WithDrift(place->second, poses[i],
                                        CameraCovariance(frame.cam_from_world, *frame.covariance)));
  }
}

}  // namespace msc_vo
