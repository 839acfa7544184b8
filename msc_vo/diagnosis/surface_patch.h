// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>

#include <Eigen/Core>
#include <opencv2/core.hpp>

namespace msc_vo {

/// A smooth, inclined part of a surface in a depth image whose values v may be any function of the
/// depth. On a plane, inverse depth g(v) is affine on the image plane z = 1, so that
/// g'' (dv)^2 + g' d2v = 0 along every direction: the bend of the values tells g.
struct SurfacePatch {
  Eigen::Vector2d center;    ///< on the plane z = 1
  double value = 0.0;        ///< v in its middle, metres if it is a depth
  Eigen::Vector2d gradient;  ///< of v on the plane z = 1
  /// - d2v / (dv)^2 along the gradient, 1/metres: g''/g' on a plane, thus -2/v if v is depth.
  double bend = 0.0;
  double bend_sigma = 0.0;
  /// Laplacian of 1/v over 1/v: 0 on a plane if v is depth.
  double bowl = 0.0;
  double bowl_sigma = 0.0;

  /// The bowl of a plane if v is the length of the viewing ray.
  double BowlOfRay() const;

  /// The bend and the bowl of a plane if v is depth and the camera has a lens that is not
  /// described: x (1 + k |x|^2) is the undistorted point of x on the plane z = 1.
  double BendOfLens(double k) const;
  double BowlOfLens(double k) const;

 private:
  // The gradient with respect to points of the undistorted plane.
  Eigen::Vector2d SlopeBeyondLens(double k) const;
};

/// Measures the patch in a part of an image. `values` (CV_32FC1; 0: none) and `rays` (CV_64FC2,
/// points of the plane z = 1) have one element per cell. `rounding`: standard deviation of rounded
/// values, in units of `values`. Returns std::nullopt if a fifth of the cells have no value or are
/// more than 72 degrees from the axis, or if the values are all equal.
std::optional<SurfacePatch> MeasurePatch(const cv::Mat_<float>& values,
                                         const cv::Mat_<cv::Vec2d>& rays, double rounding);

}  // namespace msc_vo
