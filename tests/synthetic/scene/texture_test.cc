// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/synthetic/scene/texture.h"

#include <algorithm>
#include <set>
#include <tuple>

#include <gtest/gtest.h>

namespace msc_vo {
namespace {

constexpr TextureKind kTextureKinds[] = {
    TextureKind::kPlain,   TextureKind::kPlaster, TextureKind::kWood,  TextureKind::kPlanks,
    TextureKind::kTiles,   TextureKind::kPoster,  TextureKind::kBooks, TextureKind::kRug,
    TextureKind::kSpeckle, TextureKind::kOutdoors};

// Colours of a square of 1 m x 1 m in steps of 1 cm.
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
  for (const TextureKind kind : kTextureKinds) {
    for (const Eigen::Vector3f& color : Sample({kind, {0.7f, 0.6f, 0.5f}, {0.2f, 0.1f, 0.1f}})) {
      ASSERT_TRUE(color.allFinite());
      ASSERT_GE(color.minCoeff(), 0.0f) << static_cast<int>(kind);
      ASSERT_LE(color.maxCoeff(), 1.3f) << static_cast<int>(kind);
    }
  }
}

TEST(TextureTest, IsDeterminedBySeed) {
  for (const TextureKind kind : kTextureKinds) {
    if (kind == TextureKind::kPlain) continue;
    const Texture a{kind, {0.7f, 0.6f, 0.5f}, {0.2f, 0.1f, 0.1f}, 1.0f, 1};
    Texture b = a;
    EXPECT_EQ(Sample(a), Sample(b));
    b.seed = 2;
    EXPECT_NE(Sample(a), Sample(b)) << static_cast<int>(kind);
  }
}

TEST(TextureTest, PlainIsUniformAndPlasterIsSmooth) {
  const Eigen::Vector3f color(0.8f, 0.7f, 0.6f);
  for (const Eigen::Vector3f& c : Sample({TextureKind::kPlain, color})) EXPECT_EQ(c, color);
  // Changes by less than two grey values (of 255) per centimetre.
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

TEST(TextureTest, TilesHaveGroutAtRegularSpacing) {
  const Texture tiles{TextureKind::kTiles, {0.9f, 0.9f, 0.9f}, {0.2f, 0.2f, 0.2f}};
  // Tiles are 20 cm wide; each begins with a joint.
  for (int tile = 0; tile < 5; ++tile) {
    EXPECT_EQ(EvaluateTexture(tiles, {0.2f * tile + 0.003f, 0.1f, 1, 1}), tiles.accent);
    EXPECT_NE(EvaluateTexture(tiles, {0.2f * tile + 0.1f, 0.1f, 1, 1}), tiles.accent);
  }
}

struct EdgeCount {
  int edges = 0;
  int samples = 0;  // along the edges
  int visible = 0;  // samples where the colour changes by more than grain and stains do

  double VisibleRatio() const { return static_cast<double>(visible) / samples; }
};

// Counts the edges of a texture that are at least 15 cm long, and the samples at which the colour
// changes `shift` metres beside them.
void CountEdges(const Texture& texture, double shift, EdgeCount* count) {
  const float width = 1.3f, height = 0.9f;
  const auto color = [&](const Eigen::Vector2d& x) {
    return EvaluateTexture(texture,
                           {static_cast<float>(x.x()), static_cast<float>(x.y()), width, height});
  };
  for (const LineSegment2& edge : TextureEdges(texture, width, height)) {
    EXPECT_GE(std::min(edge.start.minCoeff(), edge.end.minCoeff()), 0.0);
    EXPECT_LE(std::max(edge.start.x(), edge.end.x()), width);
    EXPECT_LE(std::max(edge.start.y(), edge.end.y()), height);
    if (edge.Length() < 0.15) continue;
    ++count->edges;
    const Eigen::Vector2d along = edge.Direction(), side(-along.y(), along.x());
    for (double s = 0.025; s < 1.0; s += 0.05) {
      ++count->samples;
      const Eigen::Vector3f step =
          color(edge.At(s) + (shift + 0.001) * side) - color(edge.At(s) + (shift - 0.001) * side);
      if (step.cwiseAbs().maxCoeff() > 0.05f) ++count->visible;
    }
  }
}

TEST(TextureTest, EdgesCoincideWithColorChanges) {
  struct Case {
    TextureKind kind;
    double min_visible_ratio;
  };
  // Figures may have the colour of the background and overlap; joints of tiles cross other joints.
  for (const Case& c : {Case{TextureKind::kPlanks, 0.98}, Case{TextureKind::kTiles, 0.9},
                        Case{TextureKind::kPoster, 0.6}, Case{TextureKind::kRug, 0.95}}) {
    EdgeCount in_place, beside;
    for (uint32_t seed = 1; seed <= 10; ++seed) {
      const Texture texture{c.kind, {0.7f, 0.6f, 0.5f}, {0.2f, 0.1f, 0.1f}, 1.0f, seed};
      CountEdges(texture, 0.0, &in_place);
      CountEdges(texture, 0.015, &beside);
    }
    EXPECT_GE(in_place.edges, 30) << static_cast<int>(c.kind);
    EXPECT_GE(in_place.VisibleRatio(), c.min_visible_ratio) << static_cast<int>(c.kind);
    EXPECT_LE(beside.VisibleRatio(), 0.4 * c.min_visible_ratio) << static_cast<int>(c.kind);
  }
}

TEST(TextureTest, ListsAllJoints) {
  for (const TextureKind kind : {TextureKind::kPlanks, TextureKind::kTiles}) {
    const Texture texture{kind, {0.7f, 0.6f, 0.5f}, {0.2f, 0.1f, 0.1f}, 1.0f, 5};
    const std::vector<LineSegment2> edges = TextureEdges(texture, 1.0f, 1.0f);
    const auto color = [&](double s, double t) {
      return EvaluateTexture(texture, {static_cast<float>(s), static_cast<float>(t), 1.0f, 1.0f});
    };
    int num_steps = 0;
    for (double t = 0.0005; t < 0.998; t += 0.001) {  // along a column of the rectangle
      const Eigen::Vector2d x(0.37, t + 0.0005);
      if ((color(0.37, t + 0.001) - color(0.37, t)).cwiseAbs().maxCoeff() < 0.15f) continue;
      ++num_steps;
      double nearest = 1.0;
      for (const LineSegment2& edge : edges) nearest = std::min(nearest, edge.DistanceToLine(x));
      EXPECT_LT(nearest, 0.001) << t;
    }
    EXPECT_GE(num_steps, 9);
  }
}

TEST(TextureTest, OtherPatternsHaveNoEdges) {
  for (const TextureKind kind :
       {TextureKind::kPlain, TextureKind::kPlaster, TextureKind::kWood, TextureKind::kBooks,
        TextureKind::kSpeckle, TextureKind::kOutdoors}) {
    EXPECT_TRUE(TextureEdges({kind}, 2.0f, 1.0f).empty());
  }
}

TEST(TextureTest, MirroredPatternRunsBackwards) {
  Texture texture{TextureKind::kPoster, {0.8f, 0.8f, 0.8f}, {0.3f, 0.3f, 0.3f}, 1.0f, 7};
  Texture mirrored = texture;
  mirrored.mirrored = true;
  for (const float s : {0.125f, 0.25f, 0.75f}) {
    EXPECT_EQ(EvaluateTexture(texture, {s, 0.5f, 1.0f, 1.0f}),
              EvaluateTexture(mirrored, {1.0f - s, 0.5f, 1.0f, 1.0f}));
  }
  const std::vector<LineSegment2> edges = TextureEdges(texture, 1.0f, 1.0f);
  const std::vector<LineSegment2> reflected = TextureEdges(mirrored, 1.0f, 1.0f);
  ASSERT_FALSE(edges.empty());
  ASSERT_EQ(edges.size(), reflected.size());
  for (size_t i = 0; i < edges.size(); ++i) {
    EXPECT_NEAR(reflected[i].start.x(), 1.0 - edges[i].start.x(), 1e-6);
    EXPECT_EQ(reflected[i].start.y(), edges[i].start.y());
  }
}

}  // namespace
}  // namespace msc_vo
