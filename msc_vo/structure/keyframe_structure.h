// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>

#include "msc_vo/map/frame.h"
#include "msc_vo/map/noise_scale.h"
#include "msc_vo/structure/frame_structure.h"

namespace msc_vo {

// The frame with the depths of its lines refined by their parallel and perpendicular relations
// (paper: 3D Feature Position Estimation); the frame itself where there are none. `scale` is what
// the sigmas of lines are multiplied with before they say which angles are near to 0 or 90 degrees.
std::shared_ptr<const Frame> RefineStructure(const FrameStructureOptions& options,
                                             const NoiseScale& scale,
                                             std::shared_ptr<const Frame> frame);

}  // namespace msc_vo
