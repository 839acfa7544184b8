// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/synthetic/scene/renderer.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "tests/synthetic/scene/small_camera.h"
#include <gtest/gtest.h>

#include "msc_vo/geometry/so3.h"
#include "msc_vo/synthetic/scene/camera_path.h"

namespace msc_vo {
namespace {

using Vec = Eigen::Vector3d;

// A wall of 8 m x 8 m through (0, 0, 3) that faces the origin, rotated by `tilt`; the z axis of the
// world is the optical axis of a camera at the identity.
Quad Wall(const Vec& tilt, const Texture& texture) {
  const Eigen::Quaterniond turn = ExpSO3(tilt);
  const Vec u = turn * Vec(8, 0, 0), v = turn * Vec(0, -8, 0);
  return {Vec(0, 0, 3) - 0.5 * (u + v), u, v, texture};
}

Scene OneWall(const Vec& tilt, const Texture& texture = {}) {
  Scene scene;
  scene.quads.push_back(Wall(tilt, texture));
  scene.ambient = 0.8;
  return scene;
}

TEST(RendererTest, DepthOfTiltedPlanesIsExact) {
  for (const Vec& tilt : {Vec(0, 0, 0), Vec(0.5, 0, 0), Vec(0, -0.6, 0), Vec(0.3, 0.4, 0.2)}) {
    const Scene scene = OneWall(tilt);
    const RenderedImage image = Renderer(scene, kSmallCamera).Render(Rigid3());
    const Vec normal = scene.quads[0].Normal();
    for (int y = 0; y < kSmallCamera.height; y += 7) {
      for (int x = 0; x < kSmallCamera.width; x += 7) {
        const double depth = normal.dot(Vec(0, 0, 3)) / normal.dot(kSmallCamera.Ray({x, y}));
        ASSERT_NEAR(image.depth[y * kSmallCamera.width + x], depth, 1e-5) << x << " " << y;
      }
    }
  }
}

TEST(RendererTest, DepthAgreesWithRaysInFurnishedRoom) {
  const Scene scene = MakeScene(SceneKind::kRoom, 1);
  const Rigid3 cam_from_world = CameraPath(scene, PathOptions()).CamFromWorld(2.0);
  const Rigid3 world_from_cam = cam_from_world.Inverse();
  for (const double sign : {1.0, -1.0}) {
    PinholeCamera camera = kSmallCamera;
    camera.fy *= sign;
    const RenderedImage image = Renderer(scene, camera).Render(cam_from_world);
    for (int y = 0; y < camera.height; y += 3) {
      for (int x = 0; x < camera.width; x += 3) {
        const Vec ray = world_from_cam.rotation() * camera.Ray({x, y});
        const auto hit = scene.CastRay(world_from_cam.translation(), ray);
        ASSERT_TRUE(hit.has_value());
        ASSERT_NEAR(image.depth[y * camera.width + x], *hit, 1e-5) << x << " " << y;
      }
    }
  }
}

TEST(RendererTest, NegativeFyMirrorsImage) {
  const Scene scene = MakeScene(SceneKind::kRoom, 1);
  const Rigid3 cam_from_world = CameraPath(scene, PathOptions()).CamFromWorld(0.0);
  PinholeCamera mirrored = kSmallCamera;
  mirrored.fy = -mirrored.fy;
  const RenderedImage image = Renderer(scene, kSmallCamera).Render(cam_from_world);
  const RenderedImage mirror = Renderer(scene, mirrored).Render(cam_from_world);
  int different = 0;
  for (int y = 0; y < kSmallCamera.height; ++y) {
    for (int x = 0; x < kSmallCamera.width; ++x) {
      const int a = y * kSmallCamera.width + x,
                b = (kSmallCamera.height - 1 - y) * kSmallCamera.width + x;
      different += std::abs(image.depth[a] - mirror.depth[b]) > 1e-5 ? 1 : 0;
    }
  }
  EXPECT_LT(different, 5);  // pixel centres on an edge, where rounding decides
}

TEST(RendererTest, RendersEveryRowFromItsPose) {
  const Scene scene = MakeScene(SceneKind::kRoom, 1);
  const CameraPath path(scene, PathOptions());
  const Renderer renderer(scene, KinectCamera(64, 48));
  const RenderedImage first = renderer.Render(path.CamFromWorld(1.0));
  const RenderedImage second = renderer.Render(path.CamFromWorld(1.5));
  // With alternating poses, no row may depend on the rows above or below.
  const RenderedImage mixed =
      renderer.RenderRows([&](int y) { return path.CamFromWorld(y % 2 == 0 ? 1.0 : 1.5); });
  ASSERT_EQ(mixed.rgb.size(), first.rgb.size());
  ASSERT_EQ(mixed.depth.size(), first.depth.size());
  for (int i = 0; i < mixed.width * mixed.height; ++i) {
    const RenderedImage& whole = i / mixed.width % 2 == 0 ? first : second;
    ASSERT_EQ(mixed.depth[i], whole.depth[i]) << i;
    for (int k = 3 * i; k < 3 * i + 3; ++k) ASSERT_EQ(mixed.rgb[k], whole.rgb[k]) << i;
  }
  EXPECT_NE(first.depth, second.depth);
}

TEST(RendererTest, TextureIsConsistentBetweenViews) {
  const Texture poster{TextureKind::kPoster, {0.85f, 0.82f, 0.74f}, {0.1f, 0.1f, 0.1f}, 3.0f, 5};
  const Renderer renderer(OneWall({0.1, 0.2, 0}, poster), kSmallCamera);
  const Rigid3 second_from_first(ExpSO3({0.03, -0.05, 0.1}), {0.2, -0.1, 0.1});
  const RenderedImage first = renderer.Render(Rigid3()),
                      second = renderer.Render(second_from_first);
  const std::vector<uint8_t> gray_first = first.Gray(), gray_second = second.Gray();
  double sum = 0.0, shifted_sum = 0.0;
  int count = 0;
  for (int y = 0; y < kSmallCamera.height; ++y) {
    for (int x = 0; x < kSmallCamera.width; ++x) {
      const int i = y * kSmallCamera.width + x;
      const Vec there = second_from_first * kSmallCamera.BackProject({x, y}, first.depth[i]);
      const Eigen::Vector2d pixel = kSmallCamera.Project(there);
      if (!kSmallCamera.IsInside(pixel, 4.0)) continue;
      const int u = static_cast<int>(std::lround(pixel.x()));
      const int v = static_cast<int>(std::lround(pixel.y())), j = v * kSmallCamera.width + u;
      // Depth at the nearest pixel: the error is at most the slope of the wall over half a pixel.
      ASSERT_NEAR(second.depth[j], there.z(), 0.02);
      sum += std::abs(gray_first[i] - gray_second[j]);
      shifted_sum += std::abs(gray_first[i] - gray_second[j + 4]);
      ++count;
    }
  }
  ASSERT_GT(count, 10000);
  EXPECT_LT(sum / count, 8.0);  // errors of half a pixel at edges
  EXPECT_GT(shifted_sum / count, 2.0 * sum / count);
}

TEST(RendererTest, EdgesAreAntiAliasedAndAccurateToSubPixels) {
  // A white half-plane in front of a black wall; its border is a slanted line in the image.
  Scene scene = OneWall(Vec::Zero(), {TextureKind::kPlain, {0, 0, 0}});
  const Eigen::Quaterniond turn = ExpSO3({0, 0, 0.2});
  scene.quads.push_back({turn * Vec(0.0, 4.0, 0) + Vec(0.02, 0, 2.5),
                         turn * Vec(4, 0, 0),
                         turn * Vec(0, -8, 0),
                         {TextureKind::kPlain, {1, 1, 1}}});
  const RenderedImage image = Renderer(scene, kSmallCamera).Render(Rigid3());
  const std::vector<uint8_t> gray = image.Gray();
  const int full = *std::max_element(gray.begin(), gray.end());
  int between = 0;
  for (int y = 10; y < kSmallCamera.height - 10; ++y) {
    double black = 0.0;  // pixels of the row left of the border
    for (int x = 0; x < kSmallCamera.width; ++x) {
      const int value = gray[y * kSmallCamera.width + x];
      black += 1.0 - value / static_cast<double>(full);
      between += value > full / 10 && value < full - full / 10 ? 1 : 0;
    }
    // Where the border crosses the middle of the row: points x with turn^-1 (x - offset) . ux = 0.
    const double y_world = 2.5 * (y - kSmallCamera.cy) / kSmallCamera.fy;
    const double x_world = 0.02 - std::tan(0.2) * y_world;
    EXPECT_NEAR(black - 0.5, kSmallCamera.fx * x_world / 2.5 + kSmallCamera.cx, 0.15)
        << "row " << y;
  }
  EXPECT_GT(between, 50);
}

TEST(RendererTest, ObjectsThinnerThanPixelAreContinuous) {
  // A slanted bar, a third of a pixel wide, must be visible in every row.
  Scene scene = OneWall(Vec::Zero(), {TextureKind::kPlain, {0, 0, 0}});
  const double width = 2.0 / kSmallCamera.fx / 3.0;
  const Eigen::Quaterniond turn = ExpSO3({0, 0, 0.02});
  scene.quads.push_back({turn * Vec(0, 2, 0) + Vec(0, 0, 2),
                         turn * Vec(width, 0, 0),
                         turn * Vec(0, -4, 0),
                         {TextureKind::kPlain, {1, 1, 1}}});
  const RenderedImage image = Renderer(scene, kSmallCamera).Render(Rigid3());
  for (int y = 0; y < kSmallCamera.height; ++y) {
    double sum = 0.0;
    for (int x = 0; x < kSmallCamera.width; ++x) sum += image.rgb[3 * (y * kSmallCamera.width + x)];
    EXPECT_NEAR(sum / (0.8 * 255.0 * 1.0), 1.0 / 3.0, 0.25) << "row " << y;
    EXPECT_GT(sum, 15.0) << "row " << y;
  }
}

TEST(RendererTest, FacesOfWhiteBoxDifferInBrightness) {
  const Scene scene = MakeScene(SceneKind::kBare, 1);
  const CameraPath path(scene, PathOptions());
  for (int i = 0; i < 5; ++i) {
    const RenderedImage image = Renderer(scene, kSmallCamera).Render(path.CamFromWorld(4.0 * i));
    const std::vector<uint8_t> gray = image.Gray();
    const auto [low, high] = std::minmax_element(gray.begin(), gray.end());
    EXPECT_GT(*high - *low, 60) << i;
    EXPECT_LT(*high, 255) << i;
    EXPECT_GT(*low, 20) << i;
  }
}

TEST(RendererTest, BackSidesAreInvisible) {
  Scene scene = OneWall(Vec::Zero());
  std::swap(scene.quads[0].edge_u, scene.quads[0].edge_v);  // now it faces away
  const RenderedImage image = Renderer(scene, kSmallCamera).Render(Rigid3());
  EXPECT_EQ(*std::max_element(image.depth.begin(), image.depth.end()), 0.0f);
  EXPECT_EQ(*std::max_element(image.rgb.begin(), image.rgb.end()), 0);
}

TEST(RendererTest, ThrowsOnInvalidCamera) {
  PinholeCamera camera;
  camera.fx = 0.0;
  EXPECT_THROW(Renderer(Scene(), camera), std::invalid_argument);
}

TEST(KinectCameraTest, ScalesWithWidth) {
  const PinholeCamera camera = KinectCamera(320, 240);
  EXPECT_DOUBLE_EQ(camera.fx, 262.5);
  EXPECT_DOUBLE_EQ(camera.fy, 262.5);
  EXPECT_DOUBLE_EQ(camera.cx, 159.5);
  EXPECT_DOUBLE_EQ(camera.cy, 119.5);
}

TEST(ImageNoiseTest, HasGivenSigmaAndIsDeterminedByFrame) {
  RenderedImage flat;
  flat.width = 200;
  flat.height = 100;
  flat.rgb.assign(3 * 200 * 100, 128);
  RenderedImage a = flat, b = flat, other_frame = flat;
  AddImageNoise(2.0, 1, 5, &a);
  AddImageNoise(2.0, 1, 5, &b);
  AddImageNoise(2.0, 1, 6, &other_frame);
  EXPECT_EQ(a.rgb, b.rgb);
  EXPECT_NE(a.rgb, other_frame.rgb);
  double sum = 0.0, squares = 0.0;
  for (const uint8_t value : a.Gray()) {
    sum += value - 128.0;
    squares += (value - 128.0) * (value - 128.0);
  }
  EXPECT_NEAR(sum / 20000.0, 0.0, 0.08);
  EXPECT_NEAR(std::sqrt(squares / 20000.0), std::sqrt(4.0 + 1.0 / 12.0), 0.06);  // and rounding
}

}  // namespace
}  // namespace msc_vo
