// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>

namespace msc_vo {

struct RefinedCorner {
  cv::Point pixel;           ///< maximum of the corner response
  Eigen::Vector2d position;  ///< sub-pixel position of the corner
};

/// Refines FAST corners of one image to sub-pixel positions, in two steps.
///
/// 1. Maximum of the corner response det(M) / trace(M), where M are the moments of the gradient in
///    a 5x5 window (Harris' response without his constant): at most three steps of hill climbing
///    within `area`, then the vertex of the quadratic through the 3x3 responses around the pixel.
///    FAST responds one or two pixels inside a corner, at a position that varies between images;
///    the maximum varies less.
/// 2. Apex of the corner, where the edges in the window intersect: the least-squares solution p of
///    g . (x - p) = 0 over the gradients g at pixels x (Foerstner's point). The maximum of the
///    response lies inside the corner, by an offset in pixels that does not depend on the distance,
///    which biases the scale of the reconstruction. Structures other than corners, such as dots,
///    have no apex: as the gradient lines miss their common point by more than those of a corner
///    do, the position changes smoothly to that of the maximum, to avoid jumps between frames.
///
/// Repeatability was measured, see docs/lab/features.md.
class CornerRefiner {
 public:
  /// Keeps references to an 8-bit image and to its copy smoothed with a Gaussian of one pixel.
  /// `area` must be at least five pixels inside the image.
  CornerRefiner(const cv::Mat& gray, const cv::Mat& smooth, const cv::Rect& area)
      : gray_(gray), smooth_(smooth), area_(area) {}

  RefinedCorner Refine(const cv::Point& corner) const;

 private:
  Eigen::Vector2d BlendWithApex(const Eigen::Vector2d& maximum) const;

  const cv::Mat& gray_;
  const cv::Mat& smooth_;  // for the gradients in the apex search
  cv::Rect area_;
};

}  // namespace msc_vo
