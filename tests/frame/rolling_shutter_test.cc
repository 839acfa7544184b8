// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/frame/rolling_shutter.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/support/lenses.h"
#include "tests/support/rolling_frames.h"
#include <Eigen/LU>
#include <gmock/gmock.h>

#include "msc_vo/camera/undistorted_camera.h"

namespace msc_vo {
namespace {

constexpr double kReadout = 0.026;
const CameraVelocity kVelocity{{1.2, -0.7, 0.4}, {0.3, 0.1, -0.5}};

// Points all over the image, at 1 to 4 metres.
std::vector<Eigen::Vector3d> Points() {
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 20; ++i) {
    const double z = 1.0 + 0.15 * i;
    points.push_back({z * (-0.5 + 0.05 * i), z * (0.4 - 0.02 * ((7 * i) % 20)), z});
  }
  return points;
}

// Observes Points() and the line from the first to the last one.
Frame RollingShutterFrame(double readout_time) {
  Frame frame;
  for (const Eigen::Vector3d& point : Points()) {
    frame.points.push_back(ProjectRolling(frame.camera, point, kVelocity, readout_time));
  }
  LineFeature line;
  line.segment = {frame.points.front().pixel, frame.points.back().pixel};
  line.depth = LineDepth();
  line.depth->start = frame.points.front().inverse_depth;
  line.depth->end = frame.points.back().inverse_depth;
  frame.lines.push_back(line);
  frame.grid = FeatureGrid(frame.camera, frame.points);
  return frame;
}

double LargestError(const Frame& frame) {
  double largest = 0.0;
  for (size_t i = 0; i < frame.points.size(); ++i) {
    const Eigen::Vector2d truth = frame.camera.Project(Points()[i]);
    largest = std::max(largest, (frame.points[i].pixel - truth).norm());
  }
  return largest;
}

TEST(RollingShutter, PhaseIncreasesFromTheFirstRowToTheLast) {
  const PinholeCamera camera;
  EXPECT_DOUBLE_EQ(RowPhase(camera, {7.0, -0.5}), -0.5);
  EXPECT_DOUBLE_EQ(RowPhase(camera, {600.0, 479.5}), 0.5);
}

TEST(RollingShutter, PhaseIsThatOfTheRecordedRow) {
  Frame frame;
  frame.camera = WideCamera();
  LensDistortion lens = WideLens();
  CropToFieldOfView(100.0, &lens, &frame.camera);
  const Eigen::Vector2d undistorted = lens.Undistort(frame.camera, {100.0, 359.5});
  EXPECT_GT(std::abs(RowPhase(frame, undistorted) - 0.25), 0.03);
  frame.lens = lens;
  EXPECT_NEAR(RowPhase(frame, undistorted), 0.25, 1e-12);
}

TEST(RollingShutter, CompensatesToTheViewOfAGlobalShutter) {
  for (const double readout_time : {kReadout, -kReadout}) {
    const Frame raw = RollingShutterFrame(readout_time);
    EXPECT_GT(LargestError(raw), 5.0);
    const Frame frame = CompensateRollingShutter(raw, kVelocity, readout_time);
    EXPECT_LT(LargestError(frame), 1e-6);
    for (size_t i = 0; i < frame.points.size(); ++i) {
      EXPECT_NEAR(frame.points[i].inverse_depth, 1.0 / Points()[i].z(), 1e-9);
    }
    EXPECT_TRUE(frame.lines[0].segment.start.isApprox(frame.points.front().pixel));
    EXPECT_TRUE(frame.lines[0].segment.end.isApprox(frame.points.back().pixel));
    EXPECT_NEAR(frame.lines[0].depth->end, frame.points.back().inverse_depth, 1e-12);
    EXPECT_EQ(frame.readout_time, readout_time);
    EXPECT_EQ(frame.grid.Near(frame.points, frame.points[3].pixel, 0.1), std::vector<int>{3});
  }
}

TEST(RollingShutter, KeepsFeaturesWithZeroReadoutTime) {
  const Frame raw = RollingShutterFrame(kReadout);
  const Frame frame = CompensateRollingShutter(raw, kVelocity, 0.0);
  for (size_t i = 0; i < frame.points.size(); ++i) {
    EXPECT_EQ(frame.points[i].pixel, raw.points[i].pixel);
  }
  EXPECT_EQ(frame.velocity->angular, kVelocity.angular);
}

TEST(RollingShutter, CompensatesFeaturesWithoutDepthForRotation) {
  Frame raw;
  raw.points.push_back(PointFeature());
  raw.points[0].pixel = {100.0, 450.0};
  raw.lines.push_back(LineFeature());
  raw.lines[0].segment = {{10.0, 20.0}, {100.0, 450.0}};
  const Frame turned =
      CompensateRollingShutter(raw, {kVelocity.angular, {0.0, 0.0, 0.0}}, kReadout);
  const Frame moved = CompensateRollingShutter(raw, kVelocity, kReadout);
  EXPECT_GT((turned.points[0].pixel - raw.points[0].pixel).norm(), 1.0);
  EXPECT_EQ(moved.points[0].pixel, turned.points[0].pixel);
  EXPECT_FALSE(moved.points[0].HasDepth());
  EXPECT_TRUE(moved.lines[0].segment.end.isApprox(turned.points[0].pixel));
  EXPECT_FALSE(moved.lines[0].depth.has_value());
}

TEST(RollingShutter, KeepsDepthsPositiveWithAWrongVelocity) {
  const Frame raw = RollingShutterFrame(kReadout);
  const Frame frame =
      CompensateRollingShutter(raw, {Eigen::Vector3d::Zero(), {0.0, 0.0, 500.0}}, kReadout);
  for (size_t i = 0; i < frame.points.size(); ++i) {
    EXPECT_GT(frame.points[i].inverse_depth, 0.0);
  }
  EXPECT_GT(frame.lines[0].depth->start, 0.0);
  EXPECT_GT(frame.lines[0].depth->end, 0.0);
}

TEST(RollingShutter, CorrectsAWrongCompensation) {
  const Frame raw = RollingShutterFrame(kReadout);
  const Frame wrong =
      CompensateRollingShutter(raw, {0.7 * kVelocity.angular, {0.1, 0.0, 0.0}}, 0.6 * kReadout);
  EXPECT_GT(LargestError(wrong), 3.0);
  // Phases are computed from the compensated pixels, whose row error leaves a few percent.
  EXPECT_LT(LargestError(CompensateRollingShutter(wrong, kVelocity, kReadout)),
            0.04 * LargestError(wrong));
}

// The plane that a rolling shutter's depth image shows of {x : q . x = 1}: fitted to its inverse
// depths all over the image.
PlaneFeature RollingPlane(const PinholeCamera& camera, const Eigen::Vector3d& q) {
  Eigen::Matrix3d square_rays = Eigen::Matrix3d::Zero();
  Eigen::Vector3d rays_times_depth = Eigen::Vector3d::Zero();
  int count = 0;
  for (int y = 40; y < camera.height; y += 40) {
    for (int x = 40; x < camera.width; x += 40, ++count) {
      const Eigen::Vector3d ray = camera.Ray({x, y});
      const PointFeature point = ProjectRolling(camera, ray / q.dot(ray), kVelocity, kReadout);
      const Eigen::Vector3d recorded = camera.Ray(point.pixel);
      square_rays += recorded * recorded.transpose();
      rays_times_depth += point.inverse_depth * recorded;
    }
  }
  PlaneFeature plane;
  plane.inverse_depth = square_rays.inverse() * rays_times_depth;
  plane.mean_square_ray = square_rays / count;
  return plane;
}

TEST(RollingShutter, CompensatesPlanes) {
  const Eigen::Vector3d truth(0.1, -0.2, 0.5);
  Frame frame;
  frame.planes = {RollingPlane(frame.camera, truth)};
  const double error = (frame.planes[0].inverse_depth - truth).norm();
  EXPECT_GT(error, 1e-3);
  frame = CompensateRollingShutter(frame, kVelocity, kReadout);
  EXPECT_LT((frame.planes[0].inverse_depth - truth).norm(), 0.1 * error);
}

// A plane {x : q . x = 1} in the frame of a camera that has moved by `motion`.
Eigen::Vector3d PlaneAfter(const Rigid3& motion, const Eigen::Vector3d& q) {
  const Eigen::Vector3d turned = motion.rotation() * q;
  const double distance = 1.0 / q.norm() + turned.normalized().dot(motion.translation());
  return turned.normalized() / distance;
}

TEST(RollingShutter, PlanesOfALateDepthImageMoveByTheVelocity) {
  const Eigen::Vector3d truth(0.1, -0.2, 0.5);
  constexpr double kDelay = 0.02;
  Frame frame;
  frame.planes.resize(1);
  frame.planes[0].inverse_depth = PlaneAfter(kVelocity.Over(kDelay), truth);
  SetDepthVelocity(kVelocity, &frame);
  EXPECT_NE(frame.planes[0].inverse_depth, truth) << "the depth image is not late";
  frame.depth_motion.delay = kDelay;
  const CameraVelocity predicted{1.3 * kVelocity.angular, 0.5 * kVelocity.linear};
  SetDepthVelocity(predicted, &frame);
  EXPECT_GT((frame.planes[0].inverse_depth - truth).norm(), 1e-3);
  SetDepthVelocity(kVelocity, &frame);
  EXPECT_LT((frame.planes[0].inverse_depth - truth).norm(), 1e-12);
}

TEST(RollingShutter, RayChangeIsTheDerivativeByTheReadoutTime) {
  const Frame raw = RollingShutterFrame(kReadout);
  const Frame frame = CompensateRollingShutter(raw, kVelocity, kReadout);
  const Frame later = CompensateRollingShutter(frame, kVelocity, kReadout + 1e-6);
  for (size_t i = 0; i < frame.points.size(); ++i) {
    const PointFeature& point = frame.points[i];
    const Eigen::Vector3d ray =
        frame.camera.Ray(point.pixel) + 1e-6 * RayChange(frame, point.pixel, point.inverse_depth);
    const Eigen::Vector2d moved = frame.camera.Project(ray) - point.pixel;
    const Eigen::Vector2d truth = later.points[i].pixel - point.pixel;
    EXPECT_LT((moved - truth).norm(), 0.01 * truth.norm() + 1e-9);
  }
  EXPECT_TRUE(RayChange(raw, {10.0, 10.0}, 1.0).isZero());  // unknown velocity
}

}  // namespace
}  // namespace msc_vo
