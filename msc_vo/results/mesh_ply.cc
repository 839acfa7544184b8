// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/results/mesh_ply.h"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

// Appends a number of 32 bits, lowest byte first on any machine.
template <typename T>
void Append32(const T& value, std::string* bytes) {
  static_assert(sizeof(T) == sizeof(uint32_t), "PLY types float and int");
  uint32_t bits = 0;
  std::memcpy(&bits, &value, sizeof(bits));
  for (int i = 0; i < 4; ++i) *bytes += static_cast<char>((bits >> (8 * i)) & 0xFFU);
}

std::string Header(const ColoredMesh& mesh) {
  std::string text = FormatText(
      "ply\nformat binary_little_endian 1.0\ncomment msc_vo surface, metres\nelement vertex %zu\n"
      "property float x\nproperty float y\nproperty float z\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\n",
      mesh.positions.size());
  if (!mesh.triangles.empty()) {
    text += FormatText("element face %zu\nproperty list uchar int vertex_indices\n",
                       mesh.triangles.size());
  }
  return text + "end_header\n";
}

}  // namespace

void SortMesh(ColoredMesh* mesh) {
  const size_t size = mesh->positions.size();
  std::vector<int32_t> order(size);  // old index of each new vertex
  std::iota(order.begin(), order.end(), 0);
  const auto key = [mesh](int32_t i) {
    const Eigen::Vector3f& x = mesh->positions[i];
    return std::make_tuple(x.x(), x.y(), x.z(), mesh->colors[i]);
  };
  std::sort(order.begin(), order.end(), [&key](int32_t a, int32_t b) { return key(a) < key(b); });
  ColoredMesh sorted;
  std::vector<int32_t> new_index(size);
  for (const int32_t i : order) {
    new_index[i] = static_cast<int32_t>(sorted.positions.size());
    sorted.positions.push_back(mesh->positions[i]);
    sorted.colors.push_back(mesh->colors[i]);
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

std::string FormatMeshPly(const ColoredMesh& mesh) {
  if (mesh.colors.size() != mesh.positions.size()) {
    throw std::invalid_argument("mesh: expected one colour per vertex");
  }
  std::string bytes = Header(mesh);
  bytes.reserve(bytes.size() + 15 * mesh.positions.size() + 13 * mesh.triangles.size());
  for (size_t i = 0; i < mesh.positions.size(); ++i) {
    for (const float x : mesh.positions[i]) Append32(x, &bytes);
    for (const uint8_t channel : mesh.colors[i]) bytes += static_cast<char>(channel);
  }
  for (const std::array<int32_t, 3>& triangle : mesh.triangles) {
    bytes += static_cast<char>(triangle.size());
    for (const int32_t vertex : triangle) Append32(vertex, &bytes);
  }
  return bytes;
}

}  // namespace msc_vo
