// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/camera/lens_distortion.h"

#include <algorithm>

#include "tests/camera/freiburg1.h"
#include "tests/support/eigen_matchers.h"
#include <gmock/gmock.h>

namespace msc_vo {
namespace {

TEST(LensDistortion, ZeroDistortionIsIdentity) {
  const LensDistortion none;
  EXPECT_TRUE(none.IsZero());
  EXPECT_FALSE(kFreiburg1Lens.IsZero());
  const Eigen::Vector2d pixel(12.5, 400.25);
  EXPECT_THAT(none.Distort(kFreiburg1, pixel), IsNear(pixel, 1e-12));
  EXPECT_EQ(none.Undistort(kFreiburg1, pixel), pixel);
}

TEST(LensDistortion, AppliesEachCoefficient) {
  // Pixels equal the plane z = 1; x = (0.5, 0.2), r^2 = 0.29.
  PinholeCamera camera;
  camera.fx = camera.fy = 1.0;
  camera.cx = camera.cy = 0.0;
  const Eigen::Vector2d x(0.5, 0.2);
  const auto distort = [&](int i) {
    LensDistortion lens;
    lens.k[i] = 0.1;
    return Eigen::Vector2d(lens.Distort(camera, x) - x);
  };
  EXPECT_THAT(distort(0), IsNear(Eigen::Vector2d(0.0145, 0.0058), 1e-15));
  EXPECT_THAT(distort(1), IsNear(Eigen::Vector2d(0.004205, 0.001682), 1e-15));
  EXPECT_THAT(distort(4), IsNear(Eigen::Vector2d(0.00121945, 0.00048778), 1e-15));
  // p1: (2 x y, r^2 + 2 y^2); p2: (r^2 + 2 x^2, 2 x y).
  EXPECT_THAT(distort(2), IsNear(Eigen::Vector2d(0.02, 0.037), 1e-15));
  EXPECT_THAT(distort(3), IsNear(Eigen::Vector2d(0.079, 0.02), 1e-15));
}

TEST(LensDistortion, UndistortInvertsDistortOverWholeImage) {
  for (const double sign : {1.0, -1.0}) {
    PinholeCamera camera = kFreiburg1;
    camera.fy *= sign;
    double largest_shift = 0.0;
    for (double v = 0.0; v <= 479.0; v += 47.9) {
      for (double u = 0.0; u <= 639.0; u += 63.9) {
        const Eigen::Vector2d distorted(u, v);
        const Eigen::Vector2d undistorted = kFreiburg1Lens.Undistort(camera, distorted);
        EXPECT_THAT(kFreiburg1Lens.Distort(camera, undistorted), IsNear(distorted, 1e-6));
        largest_shift = std::max(largest_shift, (undistorted - distorted).norm());
      }
    }
    EXPECT_GT(largest_shift, 5.0);  // the distortion is not negligible
  }
}

TEST(LensDistortion, JacobianMatchesFiniteDifferences) {
  const LensDistortion lens{{0.26, -0.95, -0.05, 0.03, 1.16}};
  constexpr double kStep = 1e-6;
  const Eigen::Vector2d x(0.5, -0.3);
  Eigen::Matrix2d numeric;
  for (int i = 0; i < 2; ++i) {
    const Eigen::Vector2d step = kStep * Eigen::Vector2d::Unit(i);
    numeric.col(i) =
        (lens.DistortNormalized(x + step) - lens.DistortNormalized(x - step)) / (2.0 * kStep);
  }
  EXPECT_LT((lens.Jacobian(x) - numeric).norm(), 1e-8);
}

TEST(LensDistortion, UndistortStaysFiniteForAnyLens) {
  for (const double k1 : {-1e6, -0.3, 2.0, 1e6}) {
    const LensDistortion lens{{k1, -k1, 0.5, -0.5, k1}};
    EXPECT_TRUE(lens.Undistort(kFreiburg1, {0.0, 0.0}).allFinite()) << k1;
  }
}

}  // namespace
}  // namespace msc_vo
