// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/exports/mesh_ply.h"

#include <array>
#include <cstdint>
#include <stdexcept>

#include "msc_vo/exports/little_endian_bytes.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

std::string Header(const ColoredMesh& mesh) {
  std::string text = FormatText(
      "ply\nformat binary_little_endian 1.0\n%s\nelement vertex %zu\n"
      "property float x\nproperty float y\nproperty float z\n"
      "%sproperty uchar red\nproperty uchar green\nproperty uchar blue\n",
      kSurfaceMark, mesh.positions.size(),
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
  LittleEndianBytes bytes;
  bytes.Append(Header(mesh));
  for (size_t i = 0; i < mesh.positions.size(); ++i) {
    for (const float x : mesh.positions[i]) bytes.Add(x);
    if (!mesh.normals.empty()) {
      for (const float x : mesh.normals[i]) bytes.Add(x);
    }
    for (const uint8_t channel : mesh.colors[i]) bytes.Add(channel);
  }
  for (const std::array<int32_t, 3>& triangle : mesh.triangles) {
    bytes.Add(static_cast<uint8_t>(triangle.size()));
    for (const int32_t vertex : triangle) bytes.Add(vertex);
  }
  return bytes.bytes();
}

}  // namespace msc_vo
