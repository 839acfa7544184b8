// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <opencv2/core.hpp>

#include "msc_vo/frame/frame.h"

namespace msc_vo {

/// Computes orientations and binary descriptors of points of one image: comparisons between pairs
/// of pixels (BRIEF) in a pattern rotated to the direction of the intensity centroid, as in ORB but
/// with a different pattern.
class PointDescriptorExtractor {
 public:
  /// Smallest distance of a point from the border of the image, pixels: ORB's border. The patch has
  /// a radius of 15 px, smoothing adds 2 px.
  static constexpr int kBorder = 19;

  /// Keeps references to an 8-bit image and to its smoothed copy, whose pixels are compared.
  PointDescriptorExtractor(const cv::Mat& gray, const cv::Mat& smooth)
      : gray_(gray), smooth_(smooth) {}

  /// Direction from a pixel to the intensity centroid of the disc around it, radians in (-pi, pi].
  double Angle(const cv::Point& pixel) const;

  /// Descriptor of the patch around a pixel with orientation `angle`, radians.
  Descriptor Describe(const cv::Point& pixel, double angle) const;

 private:
  const cv::Mat& gray_;
  const cv::Mat& smooth_;
};

}  // namespace msc_vo
