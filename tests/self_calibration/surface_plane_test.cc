// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/self_calibration/surface_plane.h"

#include <cmath>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

namespace msc_vo {
namespace {

// Images of `width` pixels of a floor that ends at a wall, in the upper half of the image; as they
// are or as kept during a run.
class SurfacePlaneTest : public testing::TestWithParam<int> {
 protected:
  SurfacePlaneTest()
      : scale_(GetParam() / 640.0), depth_(480 * GetParam() / 640, GetParam(), CV_32FC1) {
    camera_ = {525.0 * scale_, 525.0 * scale_, 320.0 * scale_,
               240.0 * scale_, depth_.cols,    depth_.rows};
    for (int y = 0; y < depth_.rows; ++y) {
      for (int x = 0; x < depth_.cols; ++x)
        depth_.at<float>(y, x) = static_cast<float>(1.0 / InverseDepth({x, y}));
    }
  }

  double InverseDepth(const Eigen::Vector2d& pixel) const {
    const double y = camera_.Ray(pixel).y();
    return y < 0.0 ? 0.2 : 0.4 + y;
  }

  // The surface at a pixel of an image of 640 pixels.
  std::optional<InverseDepthPlane> SurfaceAt(double x, double y) const {
    const LinearizedCamera camera(CorrectedCamera(camera_, LensDistortion()),
                                  SensorCorrection::Vector::Zero());
    return FindSurface(camera, InverseDepthImage(depth_, 0.1, 10.0),
                       scale_ * Eigen::Vector2d(x, y));
  }
  std::optional<InverseDepthPlane> KeptSurfaceAt(double x, double y) const {
    const LinearizedCamera camera(CorrectedCamera(camera_, LensDistortion()),
                                  SensorCorrection::Vector::Zero());
    return FindSurface(camera, RecordedImage(cv::Mat(), depth_, DepthSensor::kStructuredLight),
                       scale_ * Eigen::Vector2d(x, y));
  }

  double scale_;
  cv::Mat depth_;
  PinholeCamera camera_;
};

TEST_P(SurfacePlaneTest, IsThatOfTheScene) {
  const auto plane = SurfaceAt(300.0, 400.0);
  ASSERT_TRUE(plane.has_value());
  EXPECT_NEAR(plane->inverse_depth, InverseDepth(plane->pixel), 1e-5);
  EXPECT_NEAR(plane->gradient.x(), 0.0, 1e-6);
  EXPECT_NEAR(plane->gradient.y(), 1.0 / camera_.fy, 1e-6);
}

TEST_P(SurfacePlaneTest, IsFoundInReducedImages) {
  const auto plane = KeptSurfaceAt(301.0, 401.0);
  ASSERT_TRUE(plane.has_value());
  EXPECT_NEAR(plane->inverse_depth, InverseDepth(plane->pixel), 1e-4);
  EXPECT_NEAR(plane->gradient.x(), 0.0, 1e-5);
  EXPECT_NEAR(plane->gradient.y(), 1.0 / camera_.fy, 1e-2 / camera_.fy);
  EXPECT_LE((plane->pixel - scale_ * Eigen::Vector2d(301.0, 401.0)).norm(), 2.0 * scale_ + 0.5);
  EXPECT_FALSE(KeptSurfaceAt(300.0, 238.0).has_value());
  EXPECT_FALSE(KeptSurfaceAt(300.0, 242.0).has_value());
  EXPECT_TRUE(KeptSurfaceAt(300.0, 232.0).has_value());
  EXPECT_TRUE(KeptSurfaceAt(300.0, 250.0).has_value());
}

TEST_P(SurfacePlaneTest, EndsAtTheSameAngleFromADepthEdge) {
  EXPECT_FALSE(SurfaceAt(300.0, 238.0).has_value());
  EXPECT_FALSE(SurfaceAt(300.0, 242.0).has_value());
  EXPECT_TRUE(SurfaceAt(300.0, 234.0).has_value());
  EXPECT_TRUE(SurfaceAt(300.0, 248.0).has_value());
}

TEST_P(SurfacePlaneTest, NeedsMostOfItsPixels) {
  const cv::Rect hole(cvRound(290 * scale_), cvRound(390 * scale_), cvRound(10 * scale_),
                      cvRound(20 * scale_));
  depth_(hole).setTo(0.0f);
  EXPECT_FALSE(SurfaceAt(299.0, 400.0).has_value());
  EXPECT_TRUE(SurfaceAt(310.0, 400.0).has_value());
}

INSTANTIATE_TEST_SUITE_P(Width, SurfacePlaneTest, testing::Values(320, 640, 1280, 1920));

}  // namespace
}  // namespace msc_vo
