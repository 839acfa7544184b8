// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <optional>

#include "msc_vo/geometry/line_fit.h"
#include "msc_vo/geometry/line_segment.h"
#include "msc_vo/sensor/inverse_depth_image.h"
#include "msc_vo/sensor/lens_remap.h"

namespace msc_vo {

// How a line gets its depth.
enum class LineDepthMethod {
  kRobustFit,  // samples along the line, FitLineDepth
  kEndPoints,  // the depths under the two end points, as they are: the ablation mode pl-vo
};

// Depth of a line (`segment`: pixels without distortion) by a robust fit to samples a few pixels
// apart; std::nullopt if there is no good fit. `sigma` (1/metres) is the noise of one depth pixel.
//
// At each place the depth is read along a short profile across the line, which is cut where the
// depth jumps; the line belongs to the nearest of the surfaces that reach it, since an edge in the
// image that is an edge in depth is the edge of the occluding surface. Where surfaces meet at the
// line each has a slope of its own, so that the sample is the depth of the fold. The covariance
// allows for the correlation between the noise of neighbouring depth pixels, for an error that all
// samples have in common, and for a nearer surface beside the line that the line may belong to.
std::optional<LineDepth> FitDepthAlongLine(const LineFitOptions& options,
                                           const InverseDepthImage& image, const LensRemap& lens,
                                           const LineSegment2& segment, double sigma,
                                           uint32_t seed);

// Depth of a line from its end points alone, each the nearest valid pixel within 2 px;
// std::nullopt if one of them has none.
std::optional<LineDepth> EndPointDepth(const InverseDepthImage& image, const LensRemap& lens,
                                       const LineSegment2& segment, double sigma);

}  // namespace msc_vo
