// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "msc_vo/bundle_adjustment/local_bundle_adjustment.h"

namespace msc_vo {

// Keyframes and landmarks of a window, by their ids.
struct WindowChoice {
  std::vector<int64_t> keyframes, points, lines;
};

// Covariances of what was chosen, in the same order. Zero where it is fixed; none where the window
// does not determine it, as of a point that was seen once and without depth.
struct WindowCovariance {
  // Of the rotation vector w (camera frame, radians), then the translation u (metres), where the
  // true cam_from_world is (Exp(w) q, t + u): the tangent of Rigid3Manifold.
  std::vector<std::optional<Eigen::Matrix<double, 6, 6>>> keyframes;
  std::vector<std::optional<Eigen::Matrix3d>> points;  // world, metres^2
  // Of start, then end, world, metres^2. Along the line only the anchor holds them: there it says
  // line_endpoint_prior_sigma, unless something else does better.
  std::vector<std::optional<Eigen::Matrix<double, 6, 6>>> lines;
};

// Covariances from the normal equations of the window's sum (J^T J)^-1 at `solved`, a window as
// LocalBundleAdjustment left it: observations, pairs and alignments that it rejected take no part,
// and depths that contradict neither. Each factor weighs with the derivative of its loss. As good
// as the sigmas in the data are: what is fixed counts as exact. Throws std::invalid_argument as
// LocalBundleAdjustment does, and on a choice that is not in the window.
WindowCovariance EstimateCovariance(const BundleAdjustmentOptions& options,
                                    const WindowData& solved, const WindowChoice& chosen);

// The covariance of a camera in the world from that of its cam_from_world (order as above):
// rotation vector in the world (radians), then position in the world (metres).
Eigen::Matrix<double, 6, 6> CovarianceInWorld(const Rigid3& cam_from_world,
                                              const Eigen::Matrix<double, 6, 6>& covariance);

}  // namespace msc_vo
