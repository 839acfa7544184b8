// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/odometry/odometry_pose.h"

#include "msc_vo/geometry/camera_velocity.h"
#include "msc_vo/geometry/so3.h"
#include "msc_vo/mapping/keyframe_graph.h"
#include "msc_vo/tracking/motion_model.h"
#include "msc_vo/tracking/tracked_frame.h"

namespace msc_vo {

void OdometryPose::Add(const TrackedFrame& tracked) {
  const double timestamp = tracked.frame->timestamp;
  AddMotion(tracked);
  AddCovariance(tracked);
  timestamp_ = timestamp;
  if (IsEstimated(tracked.status) || tracked.keyframe.is_due()) {
    base_from_odometry_ = cam_from_odometry_;
    base_timestamp_ = timestamp;
    in_gap_ = false;
    has_begun_ = true;
  }
}

void OdometryPose::AddMotion(const TrackedFrame& tracked) {
  const double timestamp = tracked.frame->timestamp;
  if (!tracked.cam_from_last) {
    // There is no map, or the frame begins one: the motion is unknown.
    if (!has_begun_ || !tracked.keyframe.is_due()) return;
    drift_.AddError(cam_from_odometry_.Inverse(), CovarianceOfRest(timestamp - base_timestamp_));
    return;
  }
  const Rigid3 measured = *tracked.cam_from_last * base_from_odometry_;
  if (!IsEstimated(tracked.status) || (!in_gap_ && !tracked.is_jump)) {
    cam_from_odometry_ = measured;
    in_gap_ = !IsEstimated(tracked.status);
    return;
  }
  if (in_gap_) {
    const CameraVelocity velocity =
        CameraVelocity::Of(*tracked.cam_from_last, timestamp - base_timestamp_);
    cam_from_odometry_ = velocity.Over(timestamp - timestamp_) * cam_from_odometry_;
  }
  // The motion that is missing is a known error of the pose.
  const Rigid3 missing = cam_from_odometry_ * measured.Inverse();
  Eigen::Matrix<double, 6, 1> error;
  error << LogSO3(missing.rotation()), missing.translation();
  drift_.AddError(cam_from_odometry_.Inverse(), error * error.transpose());
}

void OdometryPose::AddCovariance(const TrackedFrame& tracked) {
  const Rigid3 odometry_from_cam = cam_from_odometry_.Inverse();
  PoseCovariance own = PoseCovariance::Zero();
  if (tracked.pose.usable) own = CameraCovariance(tracked.cam_from_world, tracked.pose.covariance);
  PathDrift drift = drift_;
  // As for the pose in the world, the landmarks err together.
  drift.AddStep(odometry_from_keyframe_, odometry_from_cam,
                TransportCovariance(odometry_from_cam, CommonViewCovariance()));
  covariance_.reset();
  if (tracked.pose.usable) {
    covariance_ = CovarianceOfCamera(cam_from_odometry_, drift.At(cam_from_odometry_) + own);
  }
  if (!tracked.keyframe.is_due()) return;
  drift_.AddStep(odometry_from_keyframe_, odometry_from_cam,
                 TransportCovariance(odometry_from_cam, own));
  odometry_from_keyframe_ = odometry_from_cam;
}

}  // namespace msc_vo
