// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstddef>

#include "msc_vo/datasets/rgbd_decoder.h"
#include "msc_vo/features/frame_builder.h"
#include "msc_vo/odometry/odometry.h"
#include "msc_vo/self_calibration/sensor_calibration.h"

namespace msc_vo {

/// The default number of views: a bound of time and memory.
constexpr size_t kMaxCalibrationViews = 80;

/// Decodes up to `max_views` evenly spaced images of a sequence that were tracked in the largest
/// world (OdometryResult::map_world), and extracts their points: with the depth at the time of the
/// colour image, and without the rolling shutter if `result` knows its readout time.
CalibrationSequence MakeCalibrationViews(const RgbdDecoder& decoder,
                                         const FrameBuilderOptions& features,
                                         const OdometryResult& result,
                                         size_t max_views = kMaxCalibrationViews);

}  // namespace msc_vo
