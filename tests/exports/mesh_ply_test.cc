// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/exports/mesh_ply.h"

#include <gmock/gmock.h>

namespace msc_vo {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;

ColoredMesh Triangle() {
  ColoredMesh mesh;
  mesh.positions = {{1.0f, 0.0f, 0.0f}, {0.0f, -2.0f, 0.0f}, {0.0f, 0.0f, 0.5f}};
  mesh.colors = {{{255, 0, 1}}, {{2, 3, 4}}, {{5, 6, 7}}};
  mesh.triangles = {{{0, 1, 258}}};
  return mesh;
}

TEST(FormatMeshPly, WritesLittleEndianBytes) {
  const std::string ply = FormatMeshPly(Triangle());
  EXPECT_EQ(ply.rfind("ply\nformat binary_little_endian 1.0\n", 0), 0U);
  EXPECT_THAT(ply, HasSubstr("element vertex 3\n"));
  EXPECT_THAT(ply, HasSubstr("element face 1\nproperty list uchar int vertex_indices\n"));
  const std::string body = ply.substr(ply.find("end_header\n") + 11);
  ASSERT_EQ(body.size(), 3U * 15U + 13U);
  // 1.0f is 0x3F800000, -2.0f is 0xC0000000, 258 is 0x102.
  EXPECT_EQ(body.substr(0, 15),
            std::string("\x00\x00\x80\x3F\x00\x00\x00\x00\x00\x00\x00\x00\xFF\x00\x01", 15));
  EXPECT_EQ(body.substr(19, 4), std::string("\x00\x00\x00\xC0", 4));
  EXPECT_THAT(body,
              EndsWith(std::string("\x03\x00\x00\x00\x00\x01\x00\x00\x00\x02\x01\x00\x00", 13)));
}

TEST(FormatMeshPly, PointsHaveNoFaces) {
  ColoredMesh points = Triangle();
  points.triangles.clear();
  EXPECT_THAT(FormatMeshPly(points), Not(HasSubstr("element face")));
}

TEST(FormatMeshPly, PutsNormalsBeforeColors) {
  ColoredMesh points = Triangle();
  points.triangles.clear();
  points.normals = {{0.0f, 0.0f, 1.0f}, {0.0f, 1.0f, 0.0f}, {-2.0f, 0.0f, 0.0f}};
  const std::string ply = FormatMeshPly(points);
  EXPECT_THAT(ply, HasSubstr("property float z\nproperty float nx\nproperty float ny\n"
                             "property float nz\nproperty uchar red\n"));
  const std::string body = ply.substr(ply.find("end_header\n") + 11);
  ASSERT_EQ(body.size(), 3U * 27U);
  EXPECT_EQ(body.substr(2 * 27 + 12, 15),
            std::string("\x00\x00\x00\xC0\x00\x00\x00\x00\x00\x00\x00\x00\x05\x06\x07", 15));
  points.normals.pop_back();
  EXPECT_THROW(FormatMeshPly(points), std::invalid_argument);
}

TEST(FormatMeshPly, RefusesMissingColors) {
  ColoredMesh mesh = Triangle();
  mesh.colors.pop_back();
  EXPECT_THROW(FormatMeshPly(mesh), std::invalid_argument);
}

}  // namespace
}  // namespace msc_vo
