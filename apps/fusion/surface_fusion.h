// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstddef>
#include <memory>

#include <opencv2/core.hpp>

#include "msc_vo/camera/pinhole_camera.h"
#include "msc_vo/geometry/colored_mesh.h"
#include "msc_vo/geometry/rigid3.h"

namespace msc_vo {

struct SurfaceFusionOptions {
  PinholeCamera camera;
  double voxel_size = 0.01;        ///< metres
  double max_depth = 4.0;          ///< metres; measurements beyond it are ignored
  int min_observations = 3;        ///< of a voxel of the surface
  double max_memory_mib = 2048.0;  ///< of the voxels
};

/// Fuses depth images with known poses into a truncated signed distance function in a hash table of
/// voxel blocks, of which only those near surfaces exist. The one implementation is a module that
/// LoadSurfaceFusion() loads, so that only the users of it load its libraries.
class SurfaceFusion {
 public:
  virtual ~SurfaceFusion() = default;

  /// Adds an image without lens distortion. `depth`: CV_32FC1, metres, 0: not measured. `rgb`:
  /// CV_8UC3 of the same size. Throws std::runtime_error if the voxels need more memory than
  /// SurfaceFusionOptions::max_memory_mib.
  virtual void Add(const cv::Mat& depth, const cv::Mat& rgb, const Rigid3& cam_from_world) = 0;

  /// The surface by marching cubes, or points on it with normals, without triangles. Empty if
  /// nothing was added.
  virtual ColoredMesh Extract(bool with_triangles) const = 0;

  /// Joins the vertices of each cell of a grid, which grows until at most `max_triangles` remain.
  virtual ColoredMesh Simplify(const ColoredMesh& mesh, size_t max_triangles) const = 0;
};

/// The function of the module that makes a fusion; the caller owns the result.
using MakeSurfaceFusion = SurfaceFusion* (*)(const SurfaceFusionOptions&);
inline constexpr char kMakeSurfaceFusion[] = "msc_vo_make_surface_fusion";

}  // namespace msc_vo
