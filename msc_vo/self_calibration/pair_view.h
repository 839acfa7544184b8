// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/camera/lens_distortion.h"
#include "msc_vo/factors/rgbd_pair_reprojection.h"
#include "msc_vo/map/frame.h"

namespace msc_vo {

/// The recorded pixels of a point of a frame that was recorded through `distortion`. The surface is
/// left to the caller.
RgbdPairReprojection::View MakePairView(const LensDistortion& distortion, const Frame& frame,
                                        const PointFeature& point);

/// Variance, pixels^2, of the error that the points of an image have in common.
double CommonVariance(const Frame& frame);

}  // namespace msc_vo
