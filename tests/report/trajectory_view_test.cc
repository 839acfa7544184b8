// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/report/trajectory_view.h"

#include <cmath>

#include "fake_run.h"
#include <gtest/gtest.h>

#include "msc_vo/geometry/so3.h"

namespace msc_vo {
namespace {

TEST(TrajectoryView, UsesMeanUpDirectionAndDominantMotion) {
  const TrajectoryView view = ChooseTrajectoryView(MakeFakeRun(600));
  EXPECT_TRUE(view.up_from_cameras);
  EXPECT_TRUE(view.view_from_world.row(2).isApprox(Eigen::RowVector3d::UnitZ(), 1e-9));
  // The trajectory extends 3.2 m in x and 1.4 m in y.
  EXPECT_GT(std::abs(view.view_from_world(0, 0)), 0.99);
  EXPECT_NEAR(view.view_from_world.determinant(), 1.0, 1e-9);
}

TEST(TrajectoryView, IsIndependentOfTheWorldFrame) {
  ReportData data = MakeFakeRun(600);
  const Rigid3 other_from_world(ExpSO3({0.3, -1.0, 0.7}), {1.0, 2.0, 3.0});
  const TrajectoryView before = ChooseTrajectoryView(data);
  for (ReportFrame& frame : data.frames) {
    frame.world_from_cam = other_from_world * frame.world_from_cam;
  }
  for (ReportGroundTruthPose& pose : data.ground_truth)
    pose.position = other_from_world * pose.position;
  const TrajectoryView after = ChooseTrajectoryView(data);
  const Eigen::Matrix3d expected =
      before.view_from_world * other_from_world.rotation().conjugate().toRotationMatrix();
  EXPECT_TRUE(after.view_from_world.isApprox(expected, 1e-6));
}

TEST(TrajectoryView, UsesTheFlatDirectionWithoutCommonUp) {
  ReportData data;
  for (int i = 0; i < 40; ++i) {  // a flat ellipse in x and y; every second camera upside down
    ReportFrame frame;
    frame.world_from_cam =
        Rigid3(ExpSO3({0.0, 0.0, i % 2 ? 3.14159265358979 : 0.0}),
               {2.0 * std::cos(0.2 * i), std::sin(0.2 * i), 0.001 * std::cos(1.3 * i)});
    data.frames.push_back(frame);
  }
  const TrajectoryView view = ChooseTrajectoryView(data);
  EXPECT_FALSE(view.up_from_cameras);
  EXPECT_GT(std::abs(view.view_from_world(2, 2)), 0.999);
  EXPECT_GT(std::abs(view.view_from_world(0, 0)), 0.99);
}

TEST(TrajectoryView, IsARotationWithoutMotion) {
  ReportData data;
  data.frames.resize(3);
  const Eigen::Matrix3d view = ChooseTrajectoryView(data).view_from_world;
  EXPECT_TRUE((view * view.transpose()).isIdentity(1e-9));
  EXPECT_TRUE(view.row(2).isApprox(Eigen::RowVector3d(0.0, -1.0, 0.0)));
}

}  // namespace
}  // namespace msc_vo
