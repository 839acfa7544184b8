// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/synthetic/scene/surface_view.h"

#include <cmath>

#include <gtest/gtest.h>

#include "msc_vo/geometry/angles.h"
#include "msc_vo/synthetic/scene/camera_path.h"
#include "msc_vo/synthetic/scene/renderer.h"
#include "msc_vo/synthetic/scene/scene_builder.h"

namespace msc_vo {
namespace {

using Vec = Eigen::Vector3d;

// A wall of 12 cm in the plane y = 2, large enough to fill all images.
Scene Wall() {
  SceneBuilder builder(1);
  builder.AddBox(Rigid3(), {-50, 2.0, -50}, {50, 2.12, 50}, Texture());
  return builder.scene();
}

SurfaceView From(const Scene& scene, const Vec& position, const Vec& target) {
  return ViewSurfaces(scene, KinectCamera(64, 48), LookAt(position, target));
}

// Width of what a camera sees at a distance of 1 metre.
const double kSpan = 640.0 / 525.0;

TEST(SurfaceViewTest, OverlapOfShiftedImagesIsTheirIntersection) {
  const Scene wall = Wall();
  const SurfaceView a = From(wall, {0, 0, 0}, {0, 2, 0});
  EXPECT_DOUBLE_EQ(OverlapOf(a, a), 1.0);
  for (const double ratio : {0.25, 0.5, 0.9}) {
    const double x = ratio * 2.0 * kSpan;
    const SurfaceView b = From(wall, {x, 0, 0}, {x, 2, 0});
    EXPECT_NEAR(OverlapOf(a, b), 1.0 - ratio, 1.0 / 64.0);
    EXPECT_NEAR(OverlapOf(b, a), 1.0 - ratio, 1.0 / 64.0);
  }
  const SurfaceView beside = From(wall, {2.1 * kSpan, 0, 0}, {2.1 * kSpan, 2, 0});
  EXPECT_EQ(OverlapOf(a, beside), 0.0);
}

TEST(SurfaceViewTest, OverlapDependsOnTheDirection) {
  const Scene wall = Wall();
  const SurfaceView near = From(wall, {0, 1, 0}, {0, 2, 0}), far = From(wall, {0, 0, 0}, {0, 2, 0});
  EXPECT_DOUBLE_EQ(OverlapOf(near, far), 1.0);
  EXPECT_NEAR(OverlapOf(far, near), 0.25, 0.03);
}

TEST(SurfaceViewTest, SidesOfAWallShareNothing) {
  const Scene wall = Wall();
  const SurfaceView front = From(wall, {0, 0, 0}, {0, 2, 0});
  const SurfaceView back = From(wall, {0, 4.12, 0}, {0, 2, 0});
  EXPECT_EQ(OverlapOf(front, back), 0.0);
  EXPECT_EQ(OverlapOf(back, front), 0.0);
  EXPECT_NEAR(ViewingAngle(front, back), kPi, 1e-9);
}

TEST(SurfaceViewTest, HiddenSurfacesAreNotShared) {
  SceneBuilder builder(1);
  builder.AddBox(Rigid3(), {-50, 2.0, -50}, {50, 2.12, 50}, Texture());
  // Hides the right half of the wall from b, far from the view of a.
  builder.AddBox(Rigid3(), {0, -0.5, -50}, {50, -0.4, 50}, Texture());
  const SurfaceView a = From(builder.scene(), {0, 0, 0}, {0, 2, 0});
  const SurfaceView b = From(builder.scene(), {0, -1, 0}, {0, 2, 0});
  EXPECT_NEAR(OverlapOf(a, b), 0.5, 0.02);
}

TEST(TrueReturnsTest, NeedsADepartureAndASimilarDirection) {
  SceneBuilder builder(1);
  builder.AddHall({-3, -3, 0}, {3, 3, 3}, Texture(), Texture(), Texture());
  const auto towards = [&](double degrees) {
    const double angle = DegreesToRadians(degrees);
    return From(builder.scene(), {0, 0, 1.5}, {std::cos(angle), std::sin(angle), 1.5});
  };
  EXPECT_TRUE(FindReturns({towards(0), towards(5), towards(0)}).empty());
  EXPECT_TRUE(FindReturns({towards(0), towards(90), towards(180), towards(270)}).empty());
  const std::vector<TrueReturn> found =
      FindReturns({towards(0), towards(90), towards(180), towards(270), towards(350), towards(5)});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].first, 4);
  EXPECT_EQ(found[0].last, 5);
  EXPECT_EQ(found[0].later, 5);
  EXPECT_EQ(found[0].earlier, 0);
  EXPECT_GT(found[0].overlap, 0.85);
  // From the other side of the hall, a third of the same wall, but at 60 degrees.
  const SurfaceView slanted = From(builder.scene(), {1.5, 2.5, 1.5}, {2.0, 1.634, 1.5});
  ReturnOptions any;
  any.max_angle = kPi;
  any.min_overlap = 0.1;
  const std::vector<SurfaceView> views = {towards(0), towards(180), slanted};
  EXPECT_FALSE(FindReturns(views, any).empty());
  any.max_angle = DegreesToRadians(45.0);
  EXPECT_TRUE(FindReturns(views, any).empty());
}

}  // namespace
}  // namespace msc_vo
