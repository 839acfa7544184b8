// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>
#include <string>

#include "msc_vo/camera/lens_distortion.h"

namespace msc_vo {

/// Default of the largest horizontal field of view of an undistorted image, degrees. Chosen by
/// measurement, see docs/lab/lenses.md.
constexpr double kMaxDefaultFieldOfView = 100.0;

/// Horizontal field of view of the recorded image, degrees: between the rays of the first and the
/// last pixel of the row of the principal point; 180 for a pixel that no ray reaches. `recorded`:
/// its intrinsics.
double FieldOfView(const LensDistortion& distortion, const PinholeCamera& recorded);

/// Tests whether `field_of_view` (degrees) is one that an undistorted image can have. If not,
/// `error` names the valid range.
bool IsValidFieldOfView(double field_of_view, std::string* error);

/// Returns the pinhole camera of an undistorted image that has the size of the recorded one, the
/// principal point in its centre, and the given horizontal field of view (degrees); if none is
/// given, that of the recorded image, but at most kMaxDefaultFieldOfView.
///
/// A pinhole camera spreads a ray at angle theta over 1 / cos^2(theta) times the pixels of one on
/// the axis: the wider the field of view, the fewer pixels remain for the middle.
PinholeCamera UndistortedCamera(const LensDistortion& distortion, const PinholeCamera& recorded,
                                const std::optional<double>& field_of_view);

/// Gives the lens its undistorted image: sets distortion->recorded and changes `camera`, the
/// intrinsics of the recorded image, to those of the undistorted image. Does nothing if the two are
/// the same, because the lens is no fisheye and no field of view is given.
void CropToFieldOfView(const std::optional<double>& field_of_view, LensDistortion* distortion,
                       PinholeCamera* camera);

}  // namespace msc_vo
