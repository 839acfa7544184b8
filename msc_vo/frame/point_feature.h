// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <Eigen/Core>

#include "msc_vo/frame/descriptor.h"

namespace msc_vo {

/// Scale between adjacent pyramid levels of point features, as in ORB. A constant rather than an
/// option, because extraction, matching by projection and culling must agree on it.
constexpr double kPyramidScale = 1.2;

/// A point feature p_i of the paper. Pixels are undistorted.
struct PointFeature {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  double sigma = 1.0;  ///< pixels, standard deviation of each coordinate
  int level = 0;  ///< pyramid level, 0 is the full image; below 0: of a camera of larger images
  bool dynamic = false;              ///< on a dynamic object: must not create a landmark
  double angle = 0.0;                ///< radians, orientation in the image
  double inverse_depth = 0.0;        ///< 1/metres; 0: no depth measured
  double inverse_depth_sigma = 0.0;  ///< 1/metres; > 0 if there is a depth
  Descriptor descriptor{};

  bool HasDepth() const { return inverse_depth > 0.0; }
  void RemoveDepth() { inverse_depth = inverse_depth_sigma = 0.0; }
  /// The pixel that stands for its place, and the inverse depth there, 1/metres, with its sigma.
  const Eigen::Vector2d& Center() const { return pixel; }
  double CenterInverseDepth() const { return inverse_depth; }
  double CenterInverseDepthSigma() const { return inverse_depth_sigma; }
  /// Replaces its pixels by move(pixel, &inverse_depth), which may change the inverse depth.
  template <typename Move>
  void MovePixels(const Move& move) {
    pixel = move(pixel, &inverse_depth);
  }
};

}  // namespace msc_vo
