// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>

#include <Eigen/Core>

#include "msc_vo/factors/rgbd_pair_reprojection.h"
#include "msc_vo/self_calibration/linearized_camera.h"
#include "msc_vo/sensor/inverse_depth_image.h"
#include "msc_vo/sensor/recorded_image.h"

namespace msc_vo {

/// Fits a plane to the depth image around the point that belongs to the recorded colour pixel
/// `pixel` according to the correction of `camera`, within 7x7 pixels at an image width of 640.
/// Returns std::nullopt if pixels are missing or do not form a plane: beside a depth edge, the
/// surface that a point belongs to depends on the correction. Depth: InverseDepthImage or
/// RecordedImage.
template <typename Depth>
std::optional<InverseDepthPlane> FindSurface(const LinearizedCamera& camera, const Depth& depth,
                                             const Eigen::Vector2d& pixel);

}  // namespace msc_vo
