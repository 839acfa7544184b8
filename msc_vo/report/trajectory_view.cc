// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/report/trajectory_view.h"

#include <vector>

#include <Eigen/Eigenvalues>

namespace msc_vo {
namespace {

std::vector<Eigen::Vector3d> Positions(const ReportData& data) {
  std::vector<Eigen::Vector3d> positions;
  for (const ReportGroundTruthPose& pose : data.ground_truth) {
    if (pose.position.allFinite()) positions.push_back(pose.position);
  }
  if (!positions.empty()) return positions;
  for (const ReportFrame& frame : data.frames) {
    if (frame.world_from_cam.params.allFinite()) {
      positions.emplace_back(frame.world_from_cam.translation());
    }
  }
  return positions;
}

Eigen::Matrix3d Covariance(const std::vector<Eigen::Vector3d>& positions) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& x : positions) mean += x / static_cast<double>(positions.size());
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& x : positions) covariance += (x - mean) * (x - mean).transpose();
  return covariance;
}

// Mean over all frames of a direction given in the camera frame, in world. Its length measures how
// well the directions agree (1: all equal).
Eigen::Vector3d MeanDirection(const ReportData& data, const Eigen::Vector3d& direction_in_cam) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double count = 0.0;
  for (const ReportFrame& frame : data.frames) {
    if (!frame.world_from_cam.params.allFinite()) continue;
    sum += frame.world_from_cam.rotation() * direction_in_cam;
    count += 1.0;
  }
  return count > 0.0 ? Eigen::Vector3d(sum / count) : sum;
}

}  // namespace

TrajectoryView ChooseTrajectoryView(const ReportData& data) {
  TrajectoryView view;
  const Eigen::Matrix3d covariance = Covariance(Positions(data));
  const Eigen::Vector3d mean_up = MeanDirection(data, data.up_in_cam.normalized());
  // The mean of directions within 60 degrees of a common one has at least half the length.
  view.up_from_cameras = mean_up.norm() >= 0.5;
  Eigen::Vector3d up = mean_up.normalized();
  if (!view.up_from_cameras) {
    up = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvectors().col(0);
    if (up.dot(mean_up) < 0.0) up = -up;
  }

  // The dominant horizontal direction.
  Eigen::Matrix<double, 3, 2> plane;
  plane.col(0) = up.unitOrthogonal();
  plane.col(1) = up.cross(plane.col(0));
  const Eigen::Matrix2d in_plane = plane.transpose() * covariance * plane;
  Eigen::Vector3d right =
      plane * Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(in_plane).eigenvectors().col(1);
  const Eigen::Vector3d first_right =
      data.frames.empty() ? Eigen::Vector3d(Eigen::Vector3d::UnitX())
                          : Eigen::Vector3d(data.frames.front().world_from_cam.rotation() *
                                            Eigen::Vector3d::UnitX());
  if (right.dot(first_right) < 0.0) right = -right;
  view.view_from_world << right.transpose(), up.cross(right).transpose(), up.transpose();
  return view;
}

}  // namespace msc_vo
