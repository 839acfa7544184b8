// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>

#include "msc_vo/features/frame_builder.h"

namespace msc_vo {

/// Returns the frame with other intrinsics, and the depths that its features have in a depth image
/// that is registered as these say. `image`: the one of the frame; `options`: those of the
/// FrameBuilder, with the sensor of the run: the image may be a reduced one, whose statistics are
/// not those of the sensor. The reach of bleeding is that of this image, because it depends on the
/// registration.
/// Depth ranges are left out if the frame has dynamic features, whose surfaces must have none.
std::shared_ptr<const Frame> MeasureDepthAgain(
    const FrameBuilderOptions& options, const RgbdImage& image, const Frame& frame,
    const std::shared_ptr<const CameraIntrinsics>& intrinsics);

}  // namespace msc_vo
