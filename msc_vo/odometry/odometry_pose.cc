// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/odometry/odometry_pose.h"

#include "msc_vo/geometry/camera_velocity.h"
#include "msc_vo/tracking/tracked_frame.h"

namespace msc_vo {

void OdometryPose::Add(const TrackedFrame& tracked) {
  const double timestamp = tracked.frame->timestamp;
  const bool is_estimated = IsEstimated(tracked.status);
  if (!tracked.cam_from_last) {
    // The frame begins a map, or there is none: the motion is unknown.
  } else if (is_estimated && in_gap_) {
    const CameraVelocity velocity =
        CameraVelocity::Of(*tracked.cam_from_last, timestamp - base_timestamp_);
    cam_from_odometry_ = velocity.Over(timestamp - timestamp_) * cam_from_odometry_;
  } else {
    cam_from_odometry_ = *tracked.cam_from_last * base_from_odometry_;
    in_gap_ = !is_estimated;
  }
  timestamp_ = timestamp;
  if (is_estimated || tracked.keyframe.is_due()) {
    base_from_odometry_ = cam_from_odometry_;
    base_timestamp_ = timestamp;
    in_gap_ = false;
  }
}

}  // namespace msc_vo
