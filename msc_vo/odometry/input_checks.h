// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <optional>

#include <opencv2/core.hpp>

#include "msc_vo/camera/lens_distortion.h"
#include "msc_vo/camera/pinhole_camera.h"
#include "msc_vo/odometry/odometry_options.h"

namespace msc_vo {

// Checks of what the caller gives to Odometry. They throw std::invalid_argument that names the
// value.

/// Returns the options in effect.
OdometryOptions ValidatedOptions(const OdometryOptions& options);

/// Returns the camera.
const PinholeCamera& ValidatedCamera(const PinholeCamera& camera, const LensDistortion& distortion);

/// Checks the time stamp (seconds, up to 1e11) of image `id`, which must be later than `last`, that
/// of the image before.
void CheckTimestamp(int64_t id, double timestamp, const std::optional<double>& last);

/// Checks the time from the colour image to its depth image, seconds.
void CheckDepthDelay(int64_t id, double delay);

/// Checks the type of RgbdImage::recorded_depth, which may be empty.
void CheckRecordedDepth(int64_t id, const cv::Mat& recorded_depth);

/// Refuses a depth image that is not in metres but in raw units of a sensor.
void CheckDepthUnits(int64_t id, const cv::Mat& depth);

}  // namespace msc_vo
