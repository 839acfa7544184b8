// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/exports/ros_axes.h"

namespace msc_vo {

Eigen::Quaterniond RosFromOptical() { return {0.5, -0.5, 0.5, -0.5}; }

Eigen::Vector3d WithRosAxes(const Eigen::Vector3d& x) { return {x.z(), -x.x(), -x.y()}; }

Rigid3 WithRosAxes(const Rigid3& b_from_a) {
  const Eigen::Vector3d axis = WithRosAxes(Eigen::Vector3d(b_from_a.params.head<3>()));
  return {Eigen::Quaterniond(b_from_a.rotation().w(), axis.x(), axis.y(), axis.z()),
          WithRosAxes(Eigen::Vector3d(b_from_a.translation()))};
}

// A rotation Exp(w) of the camera in its own frame is Exp(R w) about the axes of a frame that R
// turns the camera's axes into. The sign of errors has no effect.
RosCovariance CovarianceWithRosAxes(const Eigen::Quaterniond& frame_from_cam,
                                    const PoseCovariance& camera) {
  const Eigen::Matrix3d rotation = (RosFromOptical() * frame_from_cam).toRotationMatrix();
  RosCovariance jacobian = RosCovariance::Zero();
  jacobian.topRightCorner<3, 3>() = rotation;    // position
  jacobian.bottomLeftCorner<3, 3>() = rotation;  // rotation
  return jacobian * camera * jacobian.transpose();
}

}  // namespace msc_vo
