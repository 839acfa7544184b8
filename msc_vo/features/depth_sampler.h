// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>

#include <Eigen/Core>

#include "msc_vo/sensor/inverse_depth_image.h"

namespace msc_vo {

struct DepthSample {
  double inverse_depth = 0.0;  // 1/metres, positive
  double sigma = 0.0;          // 1/metres
};

// Inverse depth of the surface that a point feature at `pixel` (of the depth image) lies on.
//
// The 5x5 pixels around it are explained by one plane, in which inverse depth is affine in the
// image. Where a plane and noise of standard deviation `sigma` (1/metres) do not explain them there
// is a depth edge: the point then belongs to the nearest surface that comes within 1.5 px of it,
// since a corner at an occlusion moves with the surface that occludes. That may be wrong: 0.3 of
// the difference to the farthest pixel is added to its sigma, in quadrature. std::nullopt if there
// is too little depth, or nothing that looks like a surface.
std::optional<DepthSample> SampleDepth(const InverseDepthImage& image, const Eigen::Vector2d& pixel,
                                       double sigma);

}  // namespace msc_vo
