// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/frame/frame_intrinsics.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace msc_vo {
namespace {

const PinholeCamera kCamera{500.0, 500.0, 320.0, 240.0, 640, 480};

std::shared_ptr<const CameraIntrinsics> Intrinsics(double k1, bool corrects_registration) {
  CameraIntrinsics intrinsics{kCamera, {}};
  intrinsics.distortion.k[0] = k1;
  if (corrects_registration) intrinsics.registration = SensorCorrection::Vector::Ones();
  return std::make_shared<CameraIntrinsics>(intrinsics);
}

std::shared_ptr<const Frame> FrameWith(const std::shared_ptr<const CameraIntrinsics>& intrinsics) {
  const auto frame = std::make_shared<Frame>();
  frame->camera = intrinsics->camera;
  frame->intrinsics = intrinsics;
  frame->points.resize(1);
  frame->points[0].pixel = {600.0, 400.0};
  frame->points[0].inverse_depth = 0.5;
  frame->points[0].inverse_depth_sigma = 0.01;
  frame->lines.resize(1);
  frame->lines[0].segment = {{100.0, 100.0}, {300.0, 200.0}};
  frame->lines[0].depth = LineDepth{0.5, 0.4, Eigen::Matrix2d::Identity()};
  frame->planes.resize(1);
  return frame;
}

TEST(ChangeIntrinsics, MovesFeaturesToTheirPlaceInTheOtherUndistortedImage) {
  const auto changed = ChangeIntrinsics(FrameWith(Intrinsics(0.0, false)), Intrinsics(-0.1, false));
  const Eigen::Vector2d ray = kCamera.Ray(changed->points[0].pixel).head<2>();
  const double scale = 1.0 - 0.1 * ray.squaredNorm();
  EXPECT_NEAR(500.0 * scale * ray.x() + 320.0, 600.0, 1e-6);
  EXPECT_EQ(changed->points[0].inverse_depth, 0.5);
  EXPECT_TRUE(changed->lines[0].depth);
}

// Also if a registration is taken back.
TEST(ChangeIntrinsics, RemovesDepthsOfOtherPixels) {
  for (const bool was_corrected : {false, true}) {
    const auto changed = ChangeIntrinsics(FrameWith(Intrinsics(0.0, was_corrected)),
                                          Intrinsics(0.0, !was_corrected));
    EXPECT_FALSE(changed->points[0].HasDepth());
    EXPECT_FALSE(changed->lines[0].depth);
    EXPECT_TRUE(changed->planes.empty());
  }
}

TEST(ChangeIntrinsics, KeepsDepthsThatWereRegisteredOtherwise) {
  const auto changed = ChangeIntrinsics(FrameWith(Intrinsics(0.0, true)), Intrinsics(0.0, true));
  EXPECT_TRUE(changed->points[0].HasDepth());
  EXPECT_TRUE(changed->lines[0].depth);
  EXPECT_EQ(changed->planes.size(), 1u);
}

// The same pixels show the same inverse depths.
TEST(ChangeIntrinsics, KeepsThePixelsOfPlanes) {
  const auto frame = std::make_shared<Frame>(*FrameWith(Intrinsics(0.0, false)));
  PlaneFeature plane;
  plane.inverse_depth = {0.1, -0.05, 0.4};
  plane.hull = {{-0.2, -0.1}, {0.3, -0.1}, {0.1, 0.3}};
  frame->planes = {plane};
  CameraIntrinsics other = *frame->intrinsics;
  other.camera = {550.0, 540.0, 330.0, 235.0, 640, 480};
  const auto changed = ChangeIntrinsics(frame, std::make_shared<CameraIntrinsics>(other));
  ASSERT_EQ(changed->planes[0].hull.size(), 3u);
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d before = plane.hull[i].homogeneous();
    const Eigen::Vector3d now = changed->planes[0].hull[i].homogeneous();
    EXPECT_LT((other.camera.Project(now) - kCamera.Project(before)).norm(), 1e-9);
    EXPECT_NEAR(changed->planes[0].inverse_depth.dot(now), plane.inverse_depth.dot(before), 1e-12);
  }
}

TEST(ChangeCamera, KeepsViewingRaysAndDepths) {
  const auto frame = FrameWith(Intrinsics(-0.1, false));
  const PinholeCamera half{250.0, 250.0, 160.0, 110.0, 320, 240};
  const auto changed = ChangeCamera(frame, half);
  EXPECT_TRUE(changed->PointInCamera(0).isApprox(frame->PointInCamera(0), 1e-12));
  EXPECT_TRUE(Eigen::Vector3d(changed->LineInCamera(0).end)
                  .isApprox(Eigen::Vector3d(frame->LineInCamera(0).end), 1e-12));
  EXPECT_EQ(changed->camera.width, 320);
  EXPECT_EQ(changed->points[0].sigma, 0.5 * frame->points[0].sigma);
}

// The recorded pixels of the features are the same.
TEST(ChangeCamera, KeepsTheLens) {
  const auto frame = FrameWith(Intrinsics(-0.1, false));
  const auto changed = ChangeCamera(frame, {250.0, 250.0, 160.0, 110.0, 320, 240});
  const Eigen::Vector2d before =
      frame->intrinsics->distortion.Distort(frame->camera, frame->points[0].pixel);
  const Eigen::Vector2d after =
      changed->intrinsics->distortion.Distort(changed->camera, changed->points[0].pixel);
  EXPECT_TRUE(after.isApprox(before, 1e-12));
}

// A point has the level at which its patch shows the same part of the scene.
TEST(ChangeCamera, ScalesPyramidLevels) {
  auto frame = std::make_shared<Frame>(*FrameWith(Intrinsics(0.0, false)));
  frame->points[0].level = 5;
  const double f = 500.0 / (kPyramidScale * kPyramidScale);
  EXPECT_EQ(ChangeCamera(frame, {f, f, 320.0, 240.0, 640, 480})->points[0].level, 3);
  // Finer than the image of a quarter of the size, which loses nothing.
  const auto quarter = ChangeCamera(frame, {125.0, 125.0, 80.0, 60.0, 160, 120});
  EXPECT_EQ(quarter->points[0].level, -3);
  EXPECT_EQ(ChangeCamera(quarter, kCamera)->points[0].level, 5);
  EXPECT_EQ(ChangeCamera(frame, kCamera), frame);
}

TEST(ChangeCamera, TakesDepthRangesFromTheSameRays) {
  auto frame = std::make_shared<Frame>(*FrameWith(Intrinsics(0.0, false)));
  frame->depth_ranges.cells.resize(DepthRanges::kColumns * DepthRanges::kRows);
  frame->depth_ranges.cells[DepthRanges::CellOf(kCamera, {418.0, 338.0})] = {0.5f, 1.0f};
  // Twice the field of view: the centre of the cell of pixel (370, 290) is on that ray.
  const PinholeCamera wide{250.0, 250.0, 321.0, 241.0, 640, 480};
  const auto changed = ChangeCamera(frame, wide);
  EXPECT_TRUE(changed->depth_ranges.cells[DepthRanges::CellOf(wide, {370.0, 290.0})].HasDepth());
  EXPECT_FALSE(changed->depth_ranges.At(0, 0).HasDepth());
}

}  // namespace
}  // namespace msc_vo
