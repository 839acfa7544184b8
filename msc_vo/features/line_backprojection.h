// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <optional>

#include "msc_vo/geometry/line_fit.h"
#include "msc_vo/geometry/line_segment.h"
#include "msc_vo/sensor/depth_noise.h"
#include "msc_vo/sensor/inverse_depth_image.h"
#include "msc_vo/sensor/lens_remap.h"

namespace msc_vo {

/// Method of estimating the depth of a line.
enum class LineDepthMethod {
  kRobustFit,  ///< robust fit to samples along the line, FitDepthAlongLine
  kEndPoints,  ///< measured depths at the two end points, for the ablation mode pl-vo
};

/// Estimates the depth of a line by a robust fit to samples every few pixels (paper: 3D Feature
/// Position Estimation). `segment`: pixels, undistorted; `noise`: of the depth
/// pixels. Returns std::nullopt if no fit has enough inliers.
///
/// At each sample, depth is read along a short profile across the line, which is split at depth
/// edges. The line is assigned to the nearest surface that reaches it, because an image edge at a
/// depth edge is the edge of the occluding surface. Where two surfaces meet at the line, each has
/// its own slope, so the sample is the depth of the fold. The covariance includes the correlation
/// between the noise of neighbouring depth pixels, the error common to all samples, and the
/// possibility that the line belongs to a nearer surface beside it.
std::optional<LineDepth> FitDepthAlongLine(const InverseDepthImage& image, const LensRemap& lens,
                                           const LineSegment2& segment, const DepthNoise& noise,
                                           uint32_t seed);

/// Estimates the depth of a line from its end points only, each from the nearest valid pixel within
/// 2 px. Returns std::nullopt if an end point has no valid pixel.
std::optional<LineDepth> EndPointDepth(const InverseDepthImage& image, const LensRemap& lens,
                                       const LineSegment2& segment, const DepthNoise& noise);

}  // namespace msc_vo
