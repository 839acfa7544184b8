// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Axes and covariances of ROS.

#include "msc_vo/exports/ros_axes.h"

#include <cmath>

#include <gtest/gtest.h>

#include "msc_vo/geometry/so3.h"

namespace msc_vo {
namespace {

using Eigen::Vector3d;

TEST(RosAxes, PointForwardLeftAndUp) {
  const Eigen::Quaterniond turned = RosFromOptical();
  EXPECT_LT((turned * Vector3d(0, 0, 1) - Vector3d(1, 0, 0)).norm(), 1e-15);   // forward
  EXPECT_LT((turned * Vector3d(1, 0, 0) - Vector3d(0, -1, 0)).norm(), 1e-15);  // right
  EXPECT_LT((turned * Vector3d(0, 1, 0) - Vector3d(0, 0, -1)).norm(), 1e-15);  // down
}

// A camera that has walked 3 m forward, 1 m to the right and 2 m down, and turned right by 90
// degrees.
TEST(RosAxes, TellLeftFromRight) {
  const Rigid3 world_from_cam(Eigen::Quaterniond(Eigen::AngleAxisd(M_PI / 2, Vector3d::UnitY())),
                              {1.0, 2.0, 3.0});
  const Rigid3 map_from_camera = WithRosAxes(world_from_cam);
  EXPECT_LT((map_from_camera.translation() - Vector3d(3.0, -1.0, -2.0)).norm(), 1e-12);
  // It looks to the right, which is -y, and its left side points forward.
  EXPECT_LT((map_from_camera.rotation() * Vector3d(1, 0, 0) - Vector3d(0, -1, 0)).norm(), 1e-12);
  EXPECT_LT((map_from_camera.rotation() * Vector3d(0, 1, 0) - Vector3d(1, 0, 0)).norm(), 1e-12);
  EXPECT_LT((map_from_camera.rotation() * Vector3d(0, 0, 1) - Vector3d(0, 0, 1)).norm(), 1e-12);
}

TEST(RosAxes, AreThoseOfTheRotation) {
  const Rigid3 pose(ExpSO3({0.3, -1.1, 0.7}), {4.0, -2.0, 9.0});
  const Rigid3 turned(RosFromOptical(), Vector3d::Zero());
  EXPECT_LT((WithRosAxes(pose).params - (turned * pose * turned.Inverse()).params).norm(), 1e-12);
}

// Errors of position and rotation of a camera in the map of ROS, by differences of poses.
Eigen::Matrix<double, 6, 1> RosError(const Rigid3& cam_from_world,
                                     const Eigen::Matrix<double, 6, 1>& tangent) {
  const Rigid3 moved(ExpSO3(Vector3d(tangent.head<3>())) * cam_from_world.rotation(),
                     cam_from_world.translation() + tangent.tail<3>());
  const Rigid3 before = WithRosAxes(cam_from_world.Inverse());
  const Rigid3 after = WithRosAxes(moved.Inverse());
  Eigen::Matrix<double, 6, 1> error;
  error << after.translation() - before.translation(),
      LogSO3(Eigen::Quaterniond(after.rotation() * before.rotation().conjugate()));
  return error;
}

TEST(RosAxes, CovarianceIsThatOfErrorsInTheMap) {
  const Rigid3 cam_from_world(ExpSO3({0.3, -1.1, 0.7}), {4.0, -2.0, 9.0});
  // Different in every direction, and correlated.
  PoseCovariance root = PoseCovariance::Zero();
  root.diagonal() << 0.001, 0.004, 0.009, 0.01, 0.03, 0.07;
  root(4, 0) = 0.02;
  root(3, 2) = -0.05;
  root(5, 1) = 0.04;
  const PoseCovariance covariance = root * root.transpose();
  Eigen::Matrix<double, 6, 6> jacobian;
  for (int i = 0; i < 6; ++i) {
    constexpr double kStep = 1e-6;
    const Eigen::Matrix<double, 6, 1> step = Eigen::Matrix<double, 6, 1>::Unit(i) * kStep;
    jacobian.col(i) =
        (RosError(cam_from_world, step) - RosError(cam_from_world, -step)) / 2 / kStep;
  }
  const Eigen::Matrix<double, 6, 6> expected = jacobian * covariance * jacobian.transpose();
  const RosCovariance ros =
      CovarianceWithRosAxes(Eigen::Quaterniond(cam_from_world.rotation().conjugate()),
                            CameraCovariance(cam_from_world, covariance));
  EXPECT_LT((ros - expected).norm(), 1e-6 * expected.norm());
  EXPECT_GT(std::abs(expected(0, 0) - expected(1, 1)), 0.1 * expected(0, 0));
}

}  // namespace
}  // namespace msc_vo
