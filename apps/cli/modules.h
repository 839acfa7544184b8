// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>

#include "apps/fusion/surface_fusion.h"
#include "apps/video/video_file.h"

namespace msc_vo {

// Each loads a module, so that only the runs that need it have its libraries in memory, and throws
// std::runtime_error with the fix if the module is not installed.

std::unique_ptr<SurfaceFusion> LoadSurfaceFusion(const SurfaceFusionOptions& options);
std::unique_ptr<VideoFile> LoadVideoFile();
std::unique_ptr<VideoReader> LoadVideoReader();

}  // namespace msc_vo
