// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>
#include <vector>

#include <CLI/CLI.hpp>

#include "apps/cli/interrupt_guard.h"
#include "apps/cli/posed_images.h"
#include "apps/fusion/surface_fusion.h"
#include "msc_vo/datasets/rgbd_decoder.h"

namespace msc_vo {

/// Declares --voxel, --max-depth, --min-observations and --max-memory.
void AddFusionArguments(CLI::App* command, SurfaceFusionOptions* options);

/// The images that have been fused.
struct FusedImages {
  int num_images = 0;  ///< in the surface
  bool is_interrupted = false;
};

/// Adds images with poses to a surface. Those that cannot be read are left out with a warning.
FusedImages FuseImages(const RgbdDecoder& decoder, const std::vector<PosedImage>& images,
                       bool quiet, SurfaceFusion* fusion);

/// Extracts the surface, or points with normals on it, in an order that does not depend on how it
/// was found. Throws std::runtime_error if it is empty.
ColoredMesh ExtractSurface(const SurfaceFusion& fusion, const SurfaceFusionOptions& options,
                           bool with_triangles);

}  // namespace msc_vo
