// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/geometry/pose_covariance.h"

#include "msc_vo/geometry/so3.h"

namespace msc_vo {

PoseCovariance IsotropicCovariance(double rotation_sigma, double translation_sigma) {
  PoseCovariance covariance = PoseCovariance::Zero();
  covariance.diagonal().head<3>().setConstant(rotation_sigma * rotation_sigma);
  covariance.diagonal().tail<3>().setConstant(translation_sigma * translation_sigma);
  return covariance;
}

PoseCovariance ComposeCovariances(const Rigid3& c_from_b, const PoseCovariance& covariance_c_from_b,
                                  const Rigid3& b_from_a,
                                  const PoseCovariance& covariance_b_from_a) {
  const Eigen::Matrix3d rotation = c_from_b.rotation().toRotationMatrix();
  // A rotation error of c_from_b also turns the translation of b_from_a.
  PoseCovariance by_first = PoseCovariance::Identity();
  by_first.bottomLeftCorner<3, 3>() = -Skew(rotation * b_from_a.translation());
  PoseCovariance by_second = PoseCovariance::Zero();
  by_second.topLeftCorner<3, 3>() = rotation;
  by_second.bottomRightCorner<3, 3>() = rotation;
  return by_first * covariance_c_from_b * by_first.transpose() +
         by_second * covariance_b_from_a * by_second.transpose();
}

PoseCovariance CameraCovariance(const Rigid3& cam_from_world, const PoseCovariance& covariance) {
  PoseCovariance jacobian = PoseCovariance::Identity();
  jacobian.bottomLeftCorner<3, 3>() = Skew(cam_from_world.translation());
  return jacobian * covariance * jacobian.transpose();
}

PoseCovariance CovarianceOfCamera(const Rigid3& cam_from_world, const PoseCovariance& camera) {
  PoseCovariance jacobian = PoseCovariance::Identity();
  jacobian.bottomLeftCorner<3, 3>() = -Skew(cam_from_world.translation());
  return jacobian * camera * jacobian.transpose();
}

PoseCovariance TransportCovariance(const Rigid3& b_from_a, const PoseCovariance& covariance) {
  const Eigen::Matrix3d rotation = b_from_a.rotation().toRotationMatrix();
  PoseCovariance adjoint = PoseCovariance::Zero();
  adjoint.topLeftCorner<3, 3>() = rotation;
  adjoint.bottomRightCorner<3, 3>() = rotation;
  adjoint.bottomLeftCorner<3, 3>() = Skew(b_from_a.translation()) * rotation;
  return adjoint * covariance * adjoint.transpose();
}

}  // namespace msc_vo
