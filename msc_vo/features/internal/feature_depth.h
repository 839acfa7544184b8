// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include "msc_vo/features/frame_builder.h"
#include "msc_vo/features/internal/depth_source.h"
#include "msc_vo/sensor/lens_remap.h"

namespace msc_vo {

/// Measures the depth of a point at the given pixel of the raw image; none if the image has none
/// there.
void MeasureDepth(const DepthSource& depth, const Eigen::Vector2d& raw_pixel, PointFeature* point);

/// Measures the depth of all lines, which are in the ideal image.
void MeasureDepth(const FrameBuilderOptions& options, const DepthSource& depth,
                  const LensRemap& lens, std::vector<LineFeature>* lines);

}  // namespace msc_vo
