// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/exports/mesh_ply.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <stdexcept>

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
      "%sproperty uchar red\nproperty uchar green\nproperty uchar blue\n",
      mesh.positions.size(),
      mesh.normals.empty() ? "" : "property float nx\nproperty float ny\nproperty float nz\n");
  if (!mesh.triangles.empty()) {
    text += FormatText("element face %zu\nproperty list uchar int vertex_indices\n",
                       mesh.triangles.size());
  }
  return text + "end_header\n";
}

}  // namespace

std::string FormatMeshPly(const ColoredMesh& mesh) {
  if (mesh.colors.size() != mesh.positions.size()) {
    throw std::invalid_argument("mesh: expected one colour per vertex");
  }
  if (!mesh.normals.empty() && mesh.normals.size() != mesh.positions.size()) {
    throw std::invalid_argument("mesh: expected one normal per vertex, or none");
  }
  std::string bytes = Header(mesh);
  bytes.reserve(bytes.size() + 27 * mesh.positions.size() + 13 * mesh.triangles.size());
  for (size_t i = 0; i < mesh.positions.size(); ++i) {
    for (const float x : mesh.positions[i]) Append32(x, &bytes);
    if (!mesh.normals.empty()) {
      for (const float x : mesh.normals[i]) Append32(x, &bytes);
    }
    for (const uint8_t channel : mesh.colors[i]) bytes += static_cast<char>(channel);
  }
  for (const std::array<int32_t, 3>& triangle : mesh.triangles) {
    bytes += static_cast<char>(triangle.size());
    for (const int32_t vertex : triangle) Append32(vertex, &bytes);
  }
  return bytes;
}

}  // namespace msc_vo
