// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/results/tracked_features.h"

#include "tests/support/tracked_scene.h"
#include <gmock/gmock.h>

namespace msc_vo {
namespace {

std::vector<LineColor> Colors(const ViewedFeatures& features) {
  std::vector<LineColor> colors;
  for (const ViewedLine& line : features.lines) colors.push_back(line.color);
  return colors;
}

TEST(TrackedFeatures, HaveTheColorsOfTheManhattanAxes) {
  TrackedScene scene;
  EXPECT_THAT(
      Colors(TrackedFeatures(scene.View(), {})),
      testing::ElementsAre(LineColor::kAxis0, LineColor::kWithoutAxis, LineColor::kWithoutDepth));
  scene.map.axes.reset();
  EXPECT_THAT(Colors(TrackedFeatures(scene.View(), {})),
              testing::ElementsAre(LineColor::kWithoutAxis, LineColor::kWithoutAxis,
                                   LineColor::kWithoutDepth));
}

TEST(TrackedFeatures, AreThoseWithAMatch) {
  TrackedScene scene;
  const ViewedFeatures all = TrackedFeatures(scene.View(), {});
  ASSERT_EQ(all.points.size(), 2u);
  EXPECT_EQ(all.points[0].pixel, Eigen::Vector2f(100, 50));
  EXPECT_TRUE(all.points[0].has_depth);
  EXPECT_FALSE(all.points[1].has_depth);
  EXPECT_EQ(all.lines[0].end, Eigen::Vector2f(300, 200));
  scene.tracked.matches.points.pop_back();
  scene.tracked.matches.lines = {scene.tracked.matches.lines[1]};
  const ViewedFeatures some = TrackedFeatures(scene.View(), {});
  EXPECT_EQ(some.points.size(), 1u);
  ASSERT_EQ(some.lines.size(), 1u);
  EXPECT_EQ(some.lines[0].start, Eigen::Vector2f(100, 300));
}

TEST(TrackedFeatures, AreDistortedAsTheImage) {
  const TrackedScene scene;
  LensDistortion lens;
  lens.k = {0.1, 0.0, 0.0, 0.0, 0.0};
  const Eigen::Vector2f pixel = TrackedFeatures(scene.View(), lens).points[0].pixel;
  EXPECT_LT(pixel.x(), 97.0F);  // away from the centre of the image
  EXPECT_LT(pixel.y(), 48.0F);
}

TEST(ViewedMap, ContainsPlanesWithTheirAxes) {
  TrackedScene scene;
  const Eigen::Matrix3d axes = scene.map.axes->world_from_axes.toRotationMatrix();
  const PlaneExtent extent = {{0.0, 0.0, 2.0}, {0.0, 1.0, 2.0}, {1.0, 1.0, 2.0}};
  scene.map.planes.planes = {{1, Plane(-axes.col(1), 2.0), extent},
                             {2, Plane((axes.col(0) + axes.col(1)).normalized(), 2.0), extent}};
  const ReportMap map = ViewedMap(scene.map);
  ASSERT_EQ(map.planes.size(), 2u);
  EXPECT_EQ(map.planes[0].axis, 1);
  EXPECT_EQ(map.planes[0].extent, extent);
  EXPECT_EQ(map.planes[1].axis, -1);
}

TEST(ViewedMap, ContainsAllLandmarksAndAxes) {
  const TrackedScene scene;
  const ReportMap map = ViewedMap(scene.map);
  ASSERT_EQ(map.lines.size(), 3u);
  EXPECT_EQ(map.lines[0].axis, 0);
  EXPECT_EQ(map.lines[1].axis, -1);
  EXPECT_EQ(map.points.size(), 1u);
  EXPECT_TRUE(map.world_from_axes);
  EXPECT_TRUE(map.sessions.empty());
}

TEST(ViewedMap, ContainsTheKeyframesOfEarlierSessions) {
  TrackedScene scene;
  scene.map.map.BeginSession();
  const Rigid3 cam_from_world(Eigen::Quaterniond::Identity(), {1.0, 2.0, 3.0});
  scene.map.map.AddKeyframe(scene.tracked.frame, cam_from_world);
  const ReportMap map = ViewedMap(scene.map);
  ASSERT_EQ(map.sessions.size(), 1u);
  EXPECT_EQ(map.sessions[0].positions, std::vector<Eigen::Vector3d>{Eigen::Vector3d::Zero()});
}

}  // namespace
}  // namespace msc_vo
