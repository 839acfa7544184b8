// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/frame/frame_intrinsics.h"

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

TEST(ChangeIntrinsics, RemovesDepthsThatWereNotRegistered) {
  const auto changed = ChangeIntrinsics(FrameWith(Intrinsics(0.0, false)), Intrinsics(0.0, true));
  EXPECT_FALSE(changed->points[0].HasDepth());
  EXPECT_FALSE(changed->lines[0].depth);
}

TEST(ChangeIntrinsics, KeepsDepthsThatWereRegisteredOtherwise) {
  const auto changed = ChangeIntrinsics(FrameWith(Intrinsics(0.0, true)), Intrinsics(0.0, true));
  EXPECT_TRUE(changed->points[0].HasDepth());
  EXPECT_TRUE(changed->lines[0].depth);
}

}  // namespace
}  // namespace msc_vo
