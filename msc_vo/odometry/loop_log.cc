// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/odometry/loop_log.h"

#include <utility>

#include "msc_vo/geometry/so3.h"

namespace msc_vo {

void LoopLog::Record(int frame, const LoopClosure& loop) {
  const auto reference = frames_.find(loop.reference);
  loops_.push_back({frame, reference != frames_.end() ? reference->second : -1, loop.num_keyframes,
                    LogSO3(loop.new_from_old_camera.rotation()).norm(),
                    loop.new_from_old_camera.translation().norm()});
}

std::optional<WorldChange> LoopLog::FindChange(const std::vector<FrameResult>& frames,
                                               const std::vector<ReferencedPose>& poses,
                                               const MapSnapshot& map) {
  if (std::exchange(num_seen_, map.num_loops) == map.num_loops || frames.size() < 2) {
    return std::nullopt;
  }
  const FrameResult& before = frames[frames.size() - 2];
  const ReferencedPose& pose = poses[poses.size() - 2];
  if (before.world != map.world || !map.map.KnowsKeyframe(pose.reference)) return std::nullopt;
  const Rigid3 cam_from_new = pose.cam_from_reference * map.map.CamFromWorld(pose.reference);
  return WorldChange{before.world, cam_from_new.Inverse() * before.cam_from_world};
}

}  // namespace msc_vo
