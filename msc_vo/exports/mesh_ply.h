// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include "msc_vo/geometry/colored_mesh.h"

namespace msc_vo {

/// A line in the header of the files of FormatMeshPly().
inline constexpr char kSurfaceMark[] = "comment msc_vo surface, metres";

/// Formats a mesh as binary little-endian PLY: x y z (float), nx ny nz (float) if it has normals,
/// red green blue (uchar), and faces as lists of vertex_indices, unless there are no triangles.
/// Throws std::invalid_argument unless there is one colour per vertex, and one normal or none.
std::string FormatMeshPly(const ColoredMesh& mesh);

}  // namespace msc_vo
