// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/camera/pinhole_camera.h"
#include "msc_vo/frame/depth_ranges.h"
#include "msc_vo/sensor/inverse_depth_image.h"
#include "msc_vo/sensor/lens_remap.h"

namespace msc_vo {

/// Collects the depth ranges of the undistorted image of `camera` from a raw depth image. Cells
/// have the same size in the raw image: with wide-angle lenses they overlap near its border, which
/// makes the ranges wider.
DepthRanges MakeDepthRanges(const InverseDepthImage& depth, const LensRemap& lens,
                            const PinholeCamera& camera);

}  // namespace msc_vo
