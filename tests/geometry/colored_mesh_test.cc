// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/geometry/colored_mesh.h"

#include <utility>

#include <gtest/gtest.h>

namespace msc_vo {
namespace {

bool AreEqual(const ColoredMesh& a, const ColoredMesh& b) {
  return a.positions == b.positions && a.colors == b.colors && a.triangles == b.triangles;
}

TEST(SortMesh, EqualSurfacesBecomeEqual) {
  ColoredMesh mesh;
  mesh.positions = {{1.0f, 0.0f, 0.0f}, {0.0f, -2.0f, 0.0f}, {0.0f, 0.0f, 0.5f}};
  mesh.colors = {{{255, 0, 1}}, {{2, 3, 4}}, {{5, 6, 7}}};
  mesh.triangles = {{{0, 1, 2}}};
  ColoredMesh other;  // the same vertices and triangle, from another vertex on
  for (const int i : {1, 2, 0}) {
    other.positions.push_back(mesh.positions[i]);
    other.colors.push_back(mesh.colors[i]);
  }
  other.triangles = {{{0, 1, 2}}};
  EXPECT_FALSE(AreEqual(mesh, other));
  SortMesh(&mesh);
  SortMesh(&other);
  EXPECT_TRUE(AreEqual(mesh, other));
  std::swap(other.triangles[0][1], other.triangles[0][2]);  // the other side
  SortMesh(&other);
  EXPECT_FALSE(AreEqual(mesh, other));
}

TEST(SortMesh, NormalsFollowTheirVertices) {
  ColoredMesh points;
  points.positions = {{1.0f, 0.0f, 0.0f}, {0.0f, -2.0f, 0.0f}};
  points.colors = {{{255, 0, 1}}, {{2, 3, 4}}};
  points.normals = {{0.0f, 0.0f, 1.0f}, {0.0f, 1.0f, 0.0f}};
  SortMesh(&points);
  EXPECT_EQ(points.positions[0].y(), -2.0f);
  EXPECT_EQ(points.normals[0].y(), 1.0f);
  EXPECT_EQ(points.normals[1].z(), 1.0f);
}

TEST(SortMesh, OrdersPointsThatDifferInTheirNormalsOnly) {
  ColoredMesh points;
  points.positions = {{1.0f, 0.0f, 0.0f}, {1.0f, 0.0f, 0.0f}};
  points.colors = {{{1, 2, 3}}, {{1, 2, 3}}};
  points.normals = {{0.0f, 1.0f, 0.0f}, {0.0f, 0.0f, 1.0f}};
  SortMesh(&points);
  EXPECT_EQ(points.normals[0].z(), 1.0f);
  EXPECT_EQ(points.normals[1].y(), 1.0f);
}

}  // namespace
}  // namespace msc_vo
