// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>

#include "msc_vo/map/frame.h"
#include "msc_vo/problems/frame_structure_problem.h"

namespace msc_vo {

// The frame with the depths of its lines refined by their parallel and perpendicular relations
// (paper: 3D Feature Position Estimation); the frame itself where there are none.
std::shared_ptr<const Frame> RefineStructure(const FrameStructureOptions& options,
                                             std::shared_ptr<const Frame> frame);

}  // namespace msc_vo
