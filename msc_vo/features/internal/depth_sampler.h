// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>

#include <Eigen/Core>

#include "msc_vo/sensor/depth_noise.h"
#include "msc_vo/sensor/inverse_depth_image.h"

namespace msc_vo {

struct DepthSample {
  double inverse_depth = 0.0;  ///< 1/metres, positive
  double sigma = 0.0;          ///< 1/metres
};

/// Estimates the inverse depth of the surface that a point feature at `pixel` (in the depth image)
/// lies on.
///
/// A quadratic in the image is fitted to the inverse depths of the 5x5 pixels around the point. If
/// it does not explain them given `noise`, that of its nearest pixel, the window contains a depth
/// edge: the point is then assigned to the nearest surface within 1.5 px (and the sensor's edge
/// gap), because a corner at an occlusion moves with the occluding surface. As the assignment may
/// be wrong, the variance is inflated by the square of 0.3 times the difference to the farthest
/// pixel. Returns std::nullopt if there is too little depth or no surface fits.
std::optional<DepthSample> SampleDepth(const InverseDepthImage& image, const Eigen::Vector2d& pixel,
                                       const DepthNoise& noise);

}  // namespace msc_vo
