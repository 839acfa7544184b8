// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstddef>
#include <optional>

#include "msc_vo/camera/camera_intrinsics.h"
#include "msc_vo/map/map.h"
#include "msc_vo/self_calibration/pair_linearization.h"

namespace msc_vo {

/// Self-calibrating bundle adjustment (not in the paper): optimises the poses and points of a map
/// together with the colour camera's part of a correction of `given`, beginning with `start`, and
/// returns the information about it, with poses and points marginalised. The map remains as it is.
/// All frames must know their intrinsics. Depth is down-weighted and mainly fixes the scale, so
/// that its errors are not taken for those of the colour camera. Point errors are independent.
/// Returns std::nullopt if there are too few observations, or the solver fails.
/// `max_observations`: a bound of the computing time.
std::optional<CalibrationInformation> SelfCalibratingBundleAdjustment(
    const CameraIntrinsics& given, const Map& map, const SensorCorrection::Vector& start,
    size_t max_observations = 6000);

}  // namespace msc_vo
