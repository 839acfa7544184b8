// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/odometry/frame_result.h"

#include "msc_vo/frame/feature_counts.h"
#include "msc_vo/tracking/tracked_frame.h"

namespace msc_vo {

FrameResult MakeFrameResult(const TrackedFrame& tracked, int segment, int world) {
  FrameResult result;
  result.id = tracked.frame->id;
  result.timestamp = tracked.frame->timestamp;
  result.status = tracked.status;
  result.segment = segment;
  result.world = world;
  result.cam_from_world = tracked.cam_from_world;
  result.by_pose_factors = !IsEstimated(tracked.status) && tracked.pose.usable;
  result.is_keyframe = tracked.keyframe.is_due();
  result.num_points = static_cast<int>(tracked.frame->points.size());
  result.num_lines = static_cast<int>(tracked.frame->lines.size());
  result.num_with_depth = NumWithDepth(*tracked.frame);
  result.num_inlier_points = static_cast<int>(tracked.matches.points.size());
  result.num_inlier_lines = static_cast<int>(tracked.matches.lines.size());
  result.num_dynamic = tracked.pose.num_dynamic;
  if (tracked.pose.usable) result.covariance = tracked.pose.covariance;
  result.times.matching = tracked.times.matching;
  result.times.pose = tracked.times.pose;
  return result;
}

FrameResult RepeatPose(const FrameResult* before) {
  FrameResult result;
  result.world = before != nullptr ? before->world : kNoSegment;
  if (before == nullptr) return result;
  result.cam_from_world = before->cam_from_world;
  result.cam_from_odometry = before->cam_from_odometry;
  return result;
}

void Discard(const FrameResult& before, FrameResult* result) {
  // A frame that was not tracked keeps its cause.
  if (result->status == TrackingStatus::kTracked) result->cause = LossCause::kNoMatch;
  if (HasImage(result->status)) result->status = TrackingStatus::kLost;
  result->segment = before.segment;
  result->world = before.world;
  result->world_changed.reset();
  result->cam_from_world = before.cam_from_world;
  result->by_pose_factors = false;
  result->is_keyframe = false;
  result->covariance.reset();
  result->world_covariance.reset();
  result->odometry_covariance.reset();
}

}  // namespace msc_vo
