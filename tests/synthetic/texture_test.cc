// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/synthetic/texture.h"

#include <set>
#include <tuple>

#include <gtest/gtest.h>

namespace msc_vo {
namespace {

constexpr TextureKind kKinds[] = {
    TextureKind::kPlain,   TextureKind::kPlaster, TextureKind::kWood,  TextureKind::kPlanks,
    TextureKind::kTiles,   TextureKind::kPoster,  TextureKind::kBooks, TextureKind::kRug,
    TextureKind::kSpeckle, TextureKind::kOutdoors};

// Colours of a 1 m x 1 m sample in steps of 1 cm.
std::vector<Eigen::Vector3f> Sample(const Texture& texture) {
  std::vector<Eigen::Vector3f> colors;
  for (int j = 0; j < 100; ++j) {
    for (int i = 0; i < 100; ++i) {
      colors.push_back(EvaluateTexture(texture, {0.01f * i, 0.01f * j, 1.0f, 1.0f}));
    }
  }
  return colors;
}

TEST(TextureTest, ColorsAreFiniteAndInRange) {
  for (const TextureKind kind : kKinds) {
    for (const Eigen::Vector3f& color : Sample({kind, {0.7f, 0.6f, 0.5f}, {0.2f, 0.1f, 0.1f}})) {
      ASSERT_TRUE(color.allFinite());
      ASSERT_GE(color.minCoeff(), 0.0f) << static_cast<int>(kind);
      ASSERT_LE(color.maxCoeff(), 1.3f) << static_cast<int>(kind);
    }
  }
}

TEST(TextureTest, SeedsChangeEveryPatternAndRepeat) {
  for (const TextureKind kind : kKinds) {
    if (kind == TextureKind::kPlain) continue;
    const Texture a{kind, {0.7f, 0.6f, 0.5f}, {0.2f, 0.1f, 0.1f}, 1.0f, 1};
    Texture b = a;
    EXPECT_EQ(Sample(a), Sample(b));
    b.seed = 2;
    EXPECT_NE(Sample(a), Sample(b)) << static_cast<int>(kind);
  }
}

TEST(TextureTest, PlainIsOneColorAndPlasterHasNoCorners) {
  const Eigen::Vector3f color(0.8f, 0.7f, 0.6f);
  for (const Eigen::Vector3f& c : Sample({TextureKind::kPlain, color})) EXPECT_EQ(c, color);
  // Under two grey levels of 255 from one centimetre to the next.
  const std::vector<Eigen::Vector3f> plaster = Sample({TextureKind::kPlaster, color});
  for (size_t i = 1; i < plaster.size(); ++i) {
    if (i % 100 == 0) continue;
    EXPECT_LT((plaster[i] - plaster[i - 1]).cwiseAbs().maxCoeff(), 2.0f / 255.0f);
  }
}

TEST(TextureTest, PostersHaveManySharpSteps) {
  const std::vector<Eigen::Vector3f> poster =
      Sample({TextureKind::kPoster, {0.85f, 0.82f, 0.74f}, {0.1f, 0.1f, 0.1f}});
  int steps = 0;
  for (size_t i = 1; i < poster.size(); ++i) {
    if (i % 100 != 0 && (poster[i] - poster[i - 1]).cwiseAbs().maxCoeff() > 0.2f) ++steps;
  }
  EXPECT_GT(steps, 500);
}

TEST(TextureTest, TilesHaveGroutAtTheirPitch) {
  const Texture tiles{TextureKind::kTiles, {0.9f, 0.9f, 0.9f}, {0.2f, 0.2f, 0.2f}};
  // Tiles are 20 cm wide; the joint lies at the start of each.
  for (int tile = 0; tile < 5; ++tile) {
    EXPECT_EQ(EvaluateTexture(tiles, {0.2f * tile + 0.003f, 0.1f, 1, 1}), tiles.accent);
    EXPECT_NE(EvaluateTexture(tiles, {0.2f * tile + 0.1f, 0.1f, 1, 1}), tiles.accent);
  }
}

}  // namespace
}  // namespace msc_vo
