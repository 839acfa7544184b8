// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/features/depth_measurement.h"

#include "tests/features/depth_images.h"
#include "tests/features/drawing.h"
#include <gtest/gtest.h>

#include "msc_vo/frame/rolling_shutter.h"

namespace msc_vo {
namespace {

using Eigen::Vector2d;

using testing::kVgaCamera;

// Inverse depths of two slanted walls.
double FirstWall(const Vector2d& x) { return 0.5 + 0.0003 * (x.x() - 320.0); }
double SecondWall(const Vector2d& x) { return 0.6 + 0.0002 * (x.y() - 240.0); }

RgbdImage ImageOf(double (*wall)(const Vector2d&)) {
  RgbdImage image;
  image.gray =
      testing::DrawQuadrilaterals(kVgaCamera.width, kVgaCamera.height, {0.0, 0.0}, 0.0, 2.0);
  image.depth = testing::DrawDepth(kVgaCamera, wall);
  return image;
}

// Depths of both frames, whose features are the same ones.
void ExpectSameDepths(const Frame& a, const Frame& b, double tolerance) {
  ASSERT_EQ(a.points.size(), b.points.size());
  ASSERT_EQ(a.lines.size(), b.lines.size());
  for (size_t i = 0; i < a.points.size(); ++i) {
    EXPECT_NEAR(a.points[i].inverse_depth, b.points[i].inverse_depth, tolerance);
    EXPECT_NEAR(a.points[i].inverse_depth_sigma, b.points[i].inverse_depth_sigma, tolerance);
    EXPECT_LT((a.points[i].pixel - b.points[i].pixel).norm(), 0.2);
  }
  for (size_t i = 0; i < a.lines.size(); ++i) {
    ASSERT_EQ(a.lines[i].depth.has_value(), b.lines[i].depth.has_value());
    if (a.lines[i].depth) {
      EXPECT_NEAR(a.lines[i].depth->start, b.lines[i].depth->start, tolerance);
    }
  }
}

class DepthMeasurement : public ::testing::TestWithParam<double> {
 protected:
  DepthMeasurement() {
    LensDistortion lens;
    lens.k[0] = GetParam();
    builder_ = std::make_unique<FrameBuilder>(options_, kVgaCamera, lens);
  }

  // The intrinsics of the frame with another registration.
  static std::shared_ptr<const CameraIntrinsics> Registered(const Frame& frame) {
    CameraIntrinsics intrinsics = *frame.intrinsics;
    intrinsics.registration = SensorCorrection::Vector::Ones();
    return std::make_shared<CameraIntrinsics>(intrinsics);
  }

  FrameBuilderOptions options_;
  std::unique_ptr<FrameBuilder> builder_;
};

TEST_P(DepthMeasurement, IsThatOfAFrameWithTheOtherDepthImage) {
  const Frame frame = builder_->Build(ImageOf(FirstWall));
  const RgbdImage other = ImageOf(SecondWall);
  const auto measured = MeasureDepthAgain(options_, other, frame, Registered(frame));
  ExpectSameDepths(*measured, builder_->Build(other), 1e-5);
}

TEST_P(DepthMeasurement, LooksWhereARollingShutterHasRecordedTheFeature) {
  const CameraVelocity velocity{{0.8, 0.5, 0.2}, {0.1, 0.0, 0.0}};
  const double readout_time = 0.02;
  const RgbdImage other = ImageOf(SecondWall);
  const Frame frame =
      CompensateRollingShutter(builder_->Build(ImageOf(FirstWall)), velocity, readout_time);
  const auto measured = MeasureDepthAgain(options_, other, frame, Registered(frame));
  EXPECT_EQ(measured->readout_time, readout_time);
  ExpectSameDepths(*measured,
                   CompensateRollingShutter(builder_->Build(other), velocity, readout_time), 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Lenses, DepthMeasurement, ::testing::Values(0.0, -0.1));

}  // namespace
}  // namespace msc_vo
