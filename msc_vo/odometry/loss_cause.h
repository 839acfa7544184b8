// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>

#include "msc_vo/odometry/frame_result.h"

namespace msc_vo {

/// Contrast (standard deviation of the grey levels) below which an image shows nothing; sensor
/// noise is about 2.
constexpr double kMinImageContrast = 4.0;
/// Ratio of the pixels with a depth below which an image has no depth.
constexpr double kMinMeasuredDepth = 0.05;

/// The cause for a frame with image, from its numbers; std::nullopt if it is tracked.
/// `min_features`: TrackerOptions::min_initial_features; `is_implausible`:
/// TrackedFrame::is_implausible.
std::optional<LossCause> FindLossCause(const FrameResult& frame, int min_features,
                                       bool is_implausible);

/// An attribute of one or several images for messages: "with too few points and lines".
const char* Describe(LossCause cause);
/// A name for files: "uniform_image".
const char* ToString(LossCause cause);

}  // namespace msc_vo
