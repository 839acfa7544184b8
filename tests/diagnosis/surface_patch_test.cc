// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/diagnosis/surface_patch.h"

#include <cmath>
#include <functional>

#include <gtest/gtest.h>

namespace msc_vo {
namespace {

constexpr int kSize = 9;
constexpr double kCell = 0.01;  // on the plane z = 1
const Eigen::Vector2d kCenter(0.4, 0.2);

// Depth of an inclined plane at an undistorted point of the plane z = 1.
double DepthAt(const Eigen::Vector2d& x) { return 2.0 / (1.0 + 0.5 * x.x() - 0.3 * x.y()); }

// The patch of what `values` has at points of the plane z = 1.
SurfacePatch Measure(const std::function<double(const Eigen::Vector2d&)>& values) {
  cv::Mat_<float> image(kSize, kSize);
  cv::Mat_<cv::Vec2d> rays(kSize, kSize);
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const Eigen::Vector2d ray = kCenter + kCell * Eigen::Vector2d(x - kSize / 2, y - kSize / 2);
      rays(y, x) = {ray.x(), ray.y()};
      image(y, x) = static_cast<float>(values(ray));
    }
  }
  return MeasurePatch(image, rays, 1e-6).value();
}

TEST(SurfacePatch, DoesNotBendOnAPlane) {
  const SurfacePatch patch = Measure(DepthAt);
  EXPECT_NEAR(patch.value, DepthAt(kCenter), 1e-4);
  EXPECT_NEAR(patch.bend, -2.0 / patch.value, 0.01);
  EXPECT_NEAR(patch.bowl, 0.0, 0.01);
  EXPECT_DOUBLE_EQ(patch.BendOfLens(0.0), -2.0 / patch.value);
}

TEST(SurfacePatch, BendsBehindALens) {
  for (const double k : {-0.2, 0.1, 0.5}) {
    const SurfacePatch patch =
        Measure([k](const Eigen::Vector2d& x) { return DepthAt((1.0 + k * x.squaredNorm()) * x); });
    const double bend = patch.BendOfLens(k);
    EXPECT_NEAR(patch.bend, bend, 0.05 * std::abs(bend + 2.0 / patch.value)) << k;
    EXPECT_NEAR(patch.bowl, patch.BowlOfLens(k), 0.05 * std::abs(patch.BowlOfLens(k))) << k;
  }
}

TEST(SurfacePatch, IsABowlIfItHoldsTheLengthOfRays) {
  const SurfacePatch patch =
      Measure([](const Eigen::Vector2d& x) { return DepthAt(x) * x.homogeneous().norm(); });
  EXPECT_NEAR(patch.bowl, patch.BowlOfRay(), 0.05 * std::abs(patch.BowlOfRay()));
}

}  // namespace
}  // namespace msc_vo
