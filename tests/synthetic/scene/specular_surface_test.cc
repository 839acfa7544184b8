// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/synthetic/scene/specular_surface.h"

#include <cmath>

#include "tests/synthetic/scene/small_camera.h"
#include <gtest/gtest.h>

#include "msc_vo/synthetic/scene/renderer.h"
#include "msc_vo/synthetic/scene/synthetic_sequence.h"

namespace msc_vo {
namespace {

using Vec = Eigen::Vector3d;

// A rectangle parallel to the image plane of a camera at the identity, with its centre on the
// optical axis at depth `z`. It faces the camera, or away from it.
Quad Wall(double z, double side, bool faces_camera, const Texture& texture = {}) {
  const Vec u((faces_camera ? 1 : -1) * side, 0, 0), v(0, -side, 0);
  return {Vec(0, 0, z) - 0.5 * (u + v), u, v, texture};
}

// A plain grey wall 4 m ahead, and a poster 2 m behind the camera.
Scene WallAndPoster() {
  Texture poster;
  poster.kind = TextureKind::kPoster;
  Scene scene;
  scene.quads = {Wall(4.0, 20.0, true), Wall(-2.0, 3.0, false, poster)};
  scene.ambient = 0.8;
  scene.daylight.setZero();
  return scene;
}

size_t Pixel(int x, int y) { return static_cast<size_t>(y) * kSmallCamera.width + x; }

TEST(SpecularSurface, MirrorHasItsOwnDepthAndTheImageOfWhatIsBehindTheCamera) {
  Scene scene = WallAndPoster();
  scene.specular = {{Wall(3.0, 1.0, true), 1.0, 0.0, Eigen::Vector3f::Zero()}};
  const RenderedImage image = Renderer(scene, kSmallCamera).Render(Rigid3());

  // The mirror image of the poster lies 5 m behind the mirror.
  Scene virtual_scene;
  virtual_scene.ambient = scene.ambient;
  virtual_scene.daylight.setZero();
  virtual_scene.quads = {Wall(8.0, 3.0, true, scene.quads[1].texture)};
  virtual_scene.quads[0].texture.mirrored = true;
  const RenderedImage seen = Renderer(virtual_scene, kSmallCamera).Render(Rigid3());

  int num_mirror = 0, num_wall = 0;
  double contrast = 0.0;
  for (int y = 0; y < kSmallCamera.height; ++y) {
    for (int x = 0; x < kSmallCamera.width; ++x) {
      const size_t i = Pixel(x, y);
      if (std::abs(image.depth[i] - 3.0f) > 1e-5f) {
        EXPECT_NEAR(image.depth[i], 4.0, 1e-5);
        ++num_wall;
        continue;
      }
      ++num_mirror;
      EXPECT_NEAR(image.rgb[3 * i], seen.rgb[3 * i], 1) << x << ", " << y;
      contrast =
          std::max(contrast, std::abs(1.0 * image.rgb[3 * i] - image.rgb[3 * Pixel(80, 60)]));
    }
  }
  const double side = kSmallCamera.fx / 3.0;
  EXPECT_NEAR(num_mirror, side * side, 2.5 * side);
  EXPECT_GT(num_wall, num_mirror);
  EXPECT_GT(contrast, 30.0);  // the poster has a pattern
}

TEST(SpecularSurface, GlassHasItsOwnDepthAndTheImageOfWhatIsBehindIt) {
  const Scene without = WallAndPoster();
  Scene scene = without;
  scene.specular = {{Wall(3.0, 1.0, true), 0.0, 0.9, Eigen::Vector3f::Constant(0.02f)}};
  const RenderedImage image = Renderer(scene, kSmallCamera).Render(Rigid3());
  const RenderedImage bare = Renderer(without, kSmallCamera).Render(Rigid3());
  EXPECT_NEAR(image.depth[Pixel(80, 60)], 3.0, 1e-5);
  EXPECT_NEAR(image.rgb[3 * Pixel(80, 60)], 0.9 * bare.rgb[3 * Pixel(80, 60)] + 0.02 * 255, 1);
  EXPECT_EQ(image.depth[Pixel(2, 2)], bare.depth[Pixel(2, 2)]);
  EXPECT_EQ(image.rgb[3 * Pixel(2, 2)], bare.rgb[3 * Pixel(2, 2)]);
}

TEST(SpecularSurface, IsHiddenByNearerSurfaces) {
  Scene scene = WallAndPoster();
  scene.specular = {{Wall(5.0, 1.0, true), 1.0, 0.0, Eigen::Vector3f::Zero()}};
  const RenderedImage image = Renderer(scene, kSmallCamera).Render(Rigid3());
  EXPECT_NEAR(image.depth[Pixel(80, 60)], 4.0, 1e-5);
}

TEST(SpecularSurface, ReflectsLightsAndRows) {
  Scene scene = WallAndPoster();
  scene.lights = {{Vec(0.5, 0, -1), 0.8, 3.0}};
  scene.specular = {{Wall(3.0, 1.0, true), 1.0, 0.0, Eigen::Vector3f::Zero()}};
  const Scene mirrored = MirrorImage(scene, scene.specular[0].face);
  ASSERT_EQ(mirrored.lights.size(), 1U);
  EXPECT_LT((mirrored.lights[0].position - Vec(0.5, 0, 7)).norm(), 1e-12);
  ASSERT_EQ(mirrored.quads.size(), 1U);  // the wall is behind the mirror
  EXPECT_TRUE(mirrored.specular.empty());
  const Renderer renderer(scene, kSmallCamera);
  const RenderedImage rows = renderer.RenderRows([](int) { return Rigid3(); });
  EXPECT_EQ(rows.rgb, renderer.Render(Rigid3()).rgb);
}

// The surfaces of the room lie in front of its walls, where the camera sees them.
TEST(SpecularSurface, OfTheRoomIsVisible) {
  const SpecularOptions kinds[] = {{true, false, false, false},
                                   {false, true, false, false},
                                   {false, false, true, false},
                                   {false, false, false, true}};
  for (const SpecularOptions& kind : kinds) {
    Scene room = MakeScene(SceneKind::kRoom, 2);
    AddSpecularSurfaces(kind, &room);
    ASSERT_EQ(room.specular.size(), 1U);
    const Quad& face = room.specular[0].face;
    const Vec eye(0.0, 0.0, 2.0), middle = face.At(0.5, 0.5);
    EXPECT_GT(face.Normal().dot(eye - middle), 0.0);
    const Vec at = kind.floor ? face.At(0.5, 0.28) : face.At(0.4, 0.9);  // free of furniture
    const auto wall = room.CastRay(eye, at - eye);
    ASSERT_TRUE(wall);
    EXPECT_GT(*wall, 1.0);
    EXPECT_LT(*wall, 1.2);
  }
}

TEST(SpecularSurface, NeedsTheRoom) {
  SyntheticSequenceOptions options;
  options.specular.mirror = true;
  std::string error;
  EXPECT_TRUE(options.IsValid(&error)) << error;
  options.scene = SceneKind::kBare;
  EXPECT_FALSE(options.IsValid(&error));
  EXPECT_NE(error.find("room"), std::string::npos);
}

}  // namespace
}  // namespace msc_vo
