// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace msc_vo {

/// A surface of triangles with coloured vertices; without triangles a cloud of points.
struct ColoredMesh {
  std::vector<Eigen::Vector3f> positions;         ///< metres, world
  std::vector<std::array<uint8_t, 3>> colors;     ///< red, green, blue; one per vertex
  std::vector<Eigen::Vector3f> normals;           ///< unit length, one per vertex; empty: none
  std::vector<std::array<int32_t, 3>> triangles;  ///< indices of vertices
};

/// Sorts the vertices by position and the triangles by their vertices, so that equal surfaces have
/// equal files in whatever order they were found.
void SortMesh(ColoredMesh* mesh);

}  // namespace msc_vo
