// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>

#include "msc_vo/frame/frame.h"
#include "msc_vo/map/noise_scale.h"
#include "msc_vo/structure/frame_structure.h"

namespace msc_vo {

/// Returns the frame with the depths of its lines refined by their parallel and perpendicular
/// relations (paper: 3D Feature Position Estimation), or the frame itself if there are none.
/// `scale` multiplies the sigmas of the lines.
///
/// With `keep_covariance`, the covariances remain those of the fits: where the map has structural
/// terms of its own, each keyframe would count the same structure again.
std::shared_ptr<const Frame> RefineStructure(const FrameStructureOptions& options,
                                             const NoiseScale& scale, bool keep_covariance,
                                             std::shared_ptr<const Frame> frame);

}  // namespace msc_vo
