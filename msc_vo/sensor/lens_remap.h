// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include "msc_vo/camera/lens_distortion.h"

namespace msc_vo {

/// Undistorted position of every pixel of the raw image (CV_32FC2), see
/// LensDistortion::Undistort().
cv::Mat UndistortedPixels(const PinholeCamera& camera, const LensDistortion& distortion);

/// Largest size of a pixel of the undistorted image in the raw image, at least 1; 1 for a
/// radial-tangential lens, whose pixels differ by less than a few percent.
double LargestStretch(const PinholeCamera& camera, const LensDistortion& distortion);

/// Maps between the raw (distorted) image and the ideal image of the pinhole camera, which has the
/// same size, and the same intrinsics unless LensDistortion::recorded says others. Without
/// distortion the two are identical and nothing is computed.
///
/// Lines are detected in the ideal image, because a straight 3-D line is a curve in a distorted
/// image: a detector would find chords with a bias that undistortion of their end points does not
/// remove. Points are detected in the raw image, where they keep the contrast that interpolation
/// would reduce, and are undistorted exactly.
class LensRemap {
 public:
  /// Precomputes the remap tables and the mask for images of `camera`, both of which must be valid.
  LensRemap(const PinholeCamera& camera, const LensDistortion& distortion);

  /// Undistorts a raw image of the camera, 8 bits and any number of channels, with bilinear
  /// interpolation. Pixels outside it repeat its border, which adds no edge; the mask excludes
  /// them. Returns the raw image itself without distortion. Throws std::invalid_argument if the
  /// image has another type or size.
  cv::Mat Undistort(const cv::Mat& raw) const;

  /// CV_8UC1, 255 at pixels of the ideal image that lie inside the raw image; empty without
  /// distortion.
  const cv::Mat& mask() const { return mask_; }

  /// Undistorts a pixel of the raw image, see LensDistortion::Undistort().
  Eigen::Vector2d IdealFromRaw(const Eigen::Vector2d& pixel) const {
    return distortion_.Undistort(camera_, pixel);
  }
  /// Area of the ideal image that a unit of area of the raw image covers at a pixel of the ideal
  /// image.
  double Magnification(const Eigen::Vector2d& ideal_pixel) const;

  /// Distorts a pixel of the ideal image, see LensDistortion::Distort().
  Eigen::Vector2d RawFromIdeal(const Eigen::Vector2d& pixel) const {
    return distortion_.IsZero() ? pixel : distortion_.Distort(camera_, pixel);
  }

 private:
  PinholeCamera camera_;
  LensDistortion distortion_;
  // For each pixel of the ideal image: the pixel to its upper left in the raw image, which has one
  // more column and row here, and the distance from there to the right and downwards, in 32nds of a
  // pixel.
  std::vector<uint32_t> raw_pixels_;
  std::vector<uint8_t> right_, down_;
  cv::Mat mask_;
};

}  // namespace msc_vo
