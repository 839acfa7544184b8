// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/geometry/colored_mesh.h"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

namespace msc_vo {

void SortMesh(ColoredMesh* mesh) {
  const size_t size = mesh->positions.size();
  std::vector<int32_t> order(size);  // old index of each new vertex
  std::iota(order.begin(), order.end(), 0);
  const auto key = [mesh](int32_t i) {
    const Eigen::Vector3f& x = mesh->positions[i];
    const Eigen::Vector3f n = mesh->normals.empty() ? Eigen::Vector3f::Zero() : mesh->normals[i];
    return std::make_tuple(x.x(), x.y(), x.z(), mesh->colors[i], n.x(), n.y(), n.z());
  };
  std::sort(order.begin(), order.end(), [&key](int32_t a, int32_t b) { return key(a) < key(b); });
  ColoredMesh sorted;
  std::vector<int32_t> new_index(size);
  for (const int32_t i : order) {
    new_index[i] = static_cast<int32_t>(sorted.positions.size());
    sorted.positions.push_back(mesh->positions[i]);
    sorted.colors.push_back(mesh->colors[i]);
    if (!mesh->normals.empty()) sorted.normals.push_back(mesh->normals[i]);
  }
  for (std::array<int32_t, 3> triangle : mesh->triangles) {
    for (int32_t& vertex : triangle) vertex = new_index[vertex];
    // The first vertex is the lowest; the order around the triangle, which is its side, is kept.
    std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()),
                triangle.end());
    sorted.triangles.push_back(triangle);
  }
  std::sort(sorted.triangles.begin(), sorted.triangles.end());
  *mesh = std::move(sorted);
}

}  // namespace msc_vo
