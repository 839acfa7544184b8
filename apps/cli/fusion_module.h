// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>

#include "apps/fusion/surface_fusion.h"

namespace msc_vo {

/// Loads the module of surface fusion and returns a fusion of it. Throws std::runtime_error with
/// the fix if the module is not installed.
std::unique_ptr<SurfaceFusion> LoadSurfaceFusion(const SurfaceFusionOptions& options);

}  // namespace msc_vo
