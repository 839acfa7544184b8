// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>

#include "msc_vo/frame/frame.h"

namespace msc_vo {

/// Returns the frame as if it had been built with other intrinsics: its features at the undistorted
/// pixels of the same recorded ones. Returns the frame itself if it has these intrinsics already,
/// if its own are unknown, or if `intrinsics` is null.
///
/// Depths are removed if only one of the two intrinsics has a registration: they were measured at
/// other pixels. They remain if only the values of the registration differ.
///
/// Lines are moved with their end points, which neglects the little that a wrong lens bends them;
/// likewise rolling-shutter compensation keeps its displacements in pixels.
std::shared_ptr<const Frame> ChangeIntrinsics(
    std::shared_ptr<const Frame> frame, const std::shared_ptr<const CameraIntrinsics>& intrinsics);

/// Returns the frame as another camera would have recorded it from the same place: its features on
/// the same viewing rays, with the pyramid level and the pixel sigma of its focal length. Returns
/// the frame itself if it has this camera. Its rolling-shutter compensation becomes final.
std::shared_ptr<const Frame> ChangeCamera(const std::shared_ptr<const Frame>& frame,
                                          const PinholeCamera& camera);

}  // namespace msc_vo
