// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstddef>
#include <string>

#include "msc_vo/geometry/colored_mesh.h"
#include "msc_vo/geometry/timed_pose.h"

namespace msc_vo {

/// Triangles of a surface that the page still draws and stores well: about 3 MB.
inline constexpr size_t kMaxSurfaceTriangles = 150'000;

/// Whether a page was written by WriteReport() with HasViewer().
bool IsInteractiveReport(const std::string& page);

/// An interactive report with a surface as a further layer of its 3-D view, in place of the one
/// that it may have. `pose`: of one image of the run, in the world of the surface; it ties that
/// world to the one of the report, which may be that of a ground truth. Throws
/// std::invalid_argument unless IsInteractiveReport(page) and the mesh has triangles and one colour
/// per vertex.
std::string AddSurfaceLayer(const std::string& page, const ColoredMesh& mesh,
                            const TimedPose& pose);

}  // namespace msc_vo
