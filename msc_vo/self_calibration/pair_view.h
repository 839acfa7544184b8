// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstddef>

#include "msc_vo/camera/lens_distortion.h"
#include "msc_vo/factors/rgbd_pair_reprojection.h"
#include "msc_vo/frame/frame.h"

namespace msc_vo {

/// Radius, radians, in which the points of a pair of images are looked for: exceeds what a focal
/// length that is 5 % off moves a point in half an image.
constexpr double kPairSearchRadius = 0.06;
/// Fewest points that make a pair of images worth its time.
constexpr size_t kMinPairPoints = 40;

/// The recorded pixels of a point of a frame that was recorded through `distortion`. The surface is
/// left to the caller.
RgbdPairReprojection::View MakePairView(const LensDistortion& distortion, const Frame& frame,
                                        const PointFeature& point);

/// Square of the speed (pixels^2/seconds^2) with which the camera's rotation shifts the image while
/// it is read out.
double SquaredShiftRate(const Frame& frame);

/// Standard deviation, pixels, of the error of lens and depth that the points of a pair of images
/// have in common.
double CommonError(const PinholeCamera& camera);

/// Variance, pixels^2, of the error that the points of one image of an optimised map have in
/// common.
double MapCommonVariance(const PinholeCamera& camera);

/// Variance, pixels^2, of the error that the points of a pair of images have in common: of the
/// lens, of depth and of the compensation of a rolling shutter. `squared_shift_rate`: sum over both
/// images. `readout_sigma`: standard deviation of `readout_time` (seconds).
double CommonVariance(const PinholeCamera& camera, double squared_shift_rate, double readout_time,
                      double readout_sigma);

}  // namespace msc_vo
