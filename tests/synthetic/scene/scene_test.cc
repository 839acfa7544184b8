// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/synthetic/scene/scene.h"

#include <algorithm>
#include <array>
#include <string>

#include <gtest/gtest.h>

#include "msc_vo/geometry/angles.h"
#include "msc_vo/synthetic/scene/camera_path.h"
#include "msc_vo/synthetic/scene/random.h"
#include "msc_vo/synthetic/scene/scene_builder.h"

namespace msc_vo {
namespace {

using Vec = Eigen::Vector3d;

constexpr std::array<SceneKind, 15> kSceneKinds = {
    SceneKind::kRoom,    SceneKind::kCorridor, SceneKind::kBare,   SceneKind::kSlanted,
    SceneKind::kHouse,   SceneKind::kBox,      SceneKind::kRooms,  SceneKind::kMirrored,
    SceneKind::kFloors,  SceneKind::kDesks,    SceneKind::kBlank,  SceneKind::kZigZag,
    SceneKind::kDeadEnd, SceneKind::kPoster,   SceneKind::kGallery};

// True if a direction is one of the world's axes, to 1e-6 radians.
bool IsAxis(const Vec& direction) {
  for (int axis = 0; axis < 3; ++axis) {
    if (UndirectedAngle(direction, Vec(Vec::Unit(axis))) < 1e-6) return true;
  }
  return false;
}

// Fraction of the edges that are parallel to an axis.
double AxisRatio(const Scene& scene) {
  const auto count = std::count_if(scene.edges.begin(), scene.edges.end(),
                                   [](const LineSegment3& e) { return IsAxis(e.Direction()); });
  return static_cast<double>(count) / scene.edges.size();
}

TEST(QuadTest, MeasuresDistanceToFaceEdgeAndCorner) {
  const Quad quad{{0, 0, 0}, {2, 0, 0}, {0, 1, 0}, {}};
  EXPECT_DOUBLE_EQ(quad.Distance({1.0, 0.5, 0.3}), 0.3);
  EXPECT_DOUBLE_EQ(quad.Distance({2.4, 0.5, 0.3}), 0.5);
  EXPECT_DOUBLE_EQ(quad.Distance({-2, -1, 2}), 3.0);
  EXPECT_EQ(quad.Normal(), Vec(0, 0, 1));
  EXPECT_DOUBLE_EQ(quad.Area(), 2.0);
}

TEST(SceneTest, RayHitsNearestSurfaceFacingOrigin) {
  Scene scene;
  scene.quads.push_back({{-1, 2, -1}, {2, 0, 0}, {0, 0, 2}, {}});  // normal -y, at y = 2
  scene.quads.push_back({{1, 1, -1}, {-2, 0, 0}, {0, 0, 2}, {}});  // normal +y, at y = 1
  const auto hit = scene.CastRay(Vec::Zero(), {0.1, 0.5, 0.0});
  ASSERT_TRUE(hit.has_value());
  EXPECT_DOUBLE_EQ(*hit, 4.0);
  EXPECT_FALSE(scene.CastRay(Vec::Zero(), {0.6, 1.0, 0.0}).has_value());   // beside it
  EXPECT_FALSE(scene.CastRay(Vec::Zero(), {0.0, -1.0, 0.0}).has_value());  // behind it
}

TEST(SceneBuilderTest, BoxesFaceOutwardsAndHallsInwards) {
  SceneBuilder builder(1);
  builder.AddBox(Rigid3(), {1, 2, 3}, {2, 4, 6}, Texture());
  const Vec middle(1.5, 3.0, 4.5);
  ASSERT_EQ(builder.scene().quads.size(), 6u);
  double area = 0.0;
  for (const Quad& quad : builder.scene().quads) {
    EXPECT_GT(quad.Normal().dot(quad.At(0.5, 0.5) - middle), 0.49);
    EXPECT_NEAR(quad.edge_u.dot(quad.edge_v), 0.0, 1e-12);
    area += quad.Area();
  }
  EXPECT_NEAR(area, 2.0 * (1 * 2 + 2 * 3 + 1 * 3), 1e-12);
  EXPECT_EQ(builder.scene().edges.size(), 12u);

  SceneBuilder hall(1);
  hall.AddHall({1, 2, 3}, {2, 4, 6}, Texture(), Texture(), Texture());
  for (const Quad& quad : hall.scene().quads) {
    EXPECT_LT(quad.Normal().dot(quad.At(0.5, 0.5) - middle), -0.49);
  }
}

TEST(SceneTest, ParsesNamesOfScenes) {
  EXPECT_EQ(SceneKindFromName("room"), SceneKind::kRoom);
  EXPECT_EQ(SceneKindFromName("corridor"), SceneKind::kCorridor);
  EXPECT_EQ(SceneKindFromName("bare"), SceneKind::kBare);
  EXPECT_EQ(SceneKindFromName("slanted"), SceneKind::kSlanted);
  EXPECT_EQ(SceneKindFromName("house"), SceneKind::kHouse);
  EXPECT_EQ(SceneKindFromName("box"), SceneKind::kBox);
  EXPECT_EQ(SceneKindFromName("rooms"), SceneKind::kRooms);
  EXPECT_EQ(SceneKindFromName("mirrored"), SceneKind::kMirrored);
  EXPECT_EQ(SceneKindFromName("floors"), SceneKind::kFloors);
  EXPECT_EQ(SceneKindFromName("desks"), SceneKind::kDesks);
  EXPECT_EQ(SceneKindFromName("blank"), SceneKind::kBlank);
  EXPECT_EQ(SceneKindFromName("zigzag"), SceneKind::kZigZag);
  EXPECT_EQ(SceneKindFromName("dead-end"), SceneKind::kDeadEnd);
  EXPECT_EQ(SceneKindFromName("poster"), SceneKind::kPoster);
  EXPECT_EQ(SceneKindNames().size(), kSceneKinds.size());
  EXPECT_FALSE(SceneKindFromName("garden").has_value());
}

TEST(SceneTest, ConsistsOfRectanglesAndIsClosed) {
  for (const SceneKind kind : kSceneKinds) {
    const Scene scene = MakeScene(kind, 3);
    for (const Quad& quad : scene.quads) {
      EXPECT_NEAR(quad.edge_u.normalized().dot(quad.edge_v.normalized()), 0.0, 1e-9);
      EXPECT_GT(quad.Area(), 0.0);
    }
    Random random(5);
    for (int i = 0; i < 200; ++i) {
      EXPECT_TRUE(scene.CastRay(scene.tour[0].position, random.Normal3()).has_value());
    }
  }
}

TEST(SceneTest, IsDeterminedBySeed) {
  for (const SceneKind kind : kSceneKinds) {
    const Scene a = MakeScene(kind, 1), b = MakeScene(kind, 1), c = MakeScene(kind, 2);
    ASSERT_EQ(a.edges.size(), b.edges.size());
    bool differs = a.edges.size() != c.edges.size();
    for (size_t i = 0; i < a.edges.size(); ++i) {
      EXPECT_EQ(a.edges[i].start, b.edges[i].start);
      differs = differs || a.edges[i].start != c.edges[i].start;
    }
    EXPECT_TRUE(differs) << static_cast<int>(kind);
  }
}

TEST(SceneTest, EdgesFollowAxesInManhattanScenesOnly) {
  EXPECT_EQ(AxisRatio(MakeScene(SceneKind::kRoom, 1)), 1.0);
  EXPECT_EQ(AxisRatio(MakeScene(SceneKind::kCorridor, 1)), 1.0);
  EXPECT_EQ(AxisRatio(MakeScene(SceneKind::kHouse, 1)), 1.0);
  // Folds at 45 degrees between boxes aligned with the axes.
  const double bare = AxisRatio(MakeScene(SceneKind::kBare, 1));
  EXPECT_GT(bare, 0.5);
  EXPECT_LT(bare, 0.95);
  // Upright furniture in the attic has vertical edges, but none along the horizontal axes.
  for (const LineSegment3& edge : MakeScene(SceneKind::kSlanted, 1).edges) {
    EXPECT_FALSE(UndirectedAngle(edge.Direction(), Vec(1, 0, 0)) < 1e-6);
    EXPECT_FALSE(UndirectedAngle(edge.Direction(), Vec(0, 1, 0)) < 1e-6);
  }
}

TEST(SceneTest, RoomsAreTexturedAndBareScenesAreNot) {
  const auto textured = [](SceneKind kind) {
    const Scene scene = MakeScene(kind, 1);
    return std::count_if(scene.quads.begin(), scene.quads.end(), [](const Quad& quad) {
      return quad.texture.kind != TextureKind::kPlain && quad.texture.kind != TextureKind::kPlaster;
    });
  };
  EXPECT_GT(textured(SceneKind::kRoom), 300);
  EXPECT_EQ(textured(SceneKind::kBare), 0);
}

TEST(SceneTest, EdgesAndPaintedEdgesLieOnSurfaces) {
  for (const SceneKind kind : kSceneKinds) {
    const Scene scene = MakeScene(kind, 2);
    std::vector<LineSegment3> edges = scene.PaintedEdges();
    edges.insert(edges.end(), scene.edges.begin(), scene.edges.end());
    for (const LineSegment3& edge : edges) {
      EXPECT_GE(edge.Length(), kMinEdge);
      for (const double s : {0.0, 0.4, 1.0}) EXPECT_LT(scene.Clearance(edge.At(s)), 1e-6);
    }
  }
}

TEST(SceneTest, PlanksAndPostersHavePaintedEdges) {
  EXPECT_TRUE(MakeScene(SceneKind::kBare, 1).PaintedEdges().empty());
  int num_joints = 0, num_figures = 0;
  for (const LineSegment3& edge : MakeScene(SceneKind::kRoom, 1).PaintedEdges()) {
    EXPECT_TRUE(IsAxis(edge.Direction()));
    if (edge.start.z() == 0.0 && edge.end.z() == 0.0 && edge.Length() > 5.0) ++num_joints;
    if (edge.start.z() > 1.0 && edge.end.z() > 1.0 && edge.Length() < 0.4) ++num_figures;
  }
  EXPECT_GT(num_joints, 60);  // two borders of a joint every 14 cm over 5 m
  EXPECT_GT(num_figures, 5);  // of the pictures
}

TEST(SceneTest, ListsAllEdgesOfAtticShell) {
  // Seven planes, three of which meet at each corner: 3 * (7 - 2) edges by Euler's formula. Each
  // end point belongs to three edges.
  const std::vector<LineSegment3> edges = MakeScene(SceneKind::kSlanted, 1).edges;
  ASSERT_GT(edges.size(), 15u);
  for (int i = 0; i < 15; ++i) {
    for (const Vec& end : {Vec(edges[i].start), Vec(edges[i].end)}) {
      int num_meeting = 0;
      for (int j = 0; j < 15; ++j) {
        num_meeting +=
            (edges[j].start - end).norm() < 1e-9 || (edges[j].end - end).norm() < 1e-9 ? 1 : 0;
      }
      EXPECT_EQ(num_meeting, 3) << i;
    }
  }
}

}  // namespace
}  // namespace msc_vo
