// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <opencv2/core.hpp>

#include "msc_vo/map/frame.h"

namespace msc_vo {

// Orientation and binary descriptor of points of one image: BRIEF's comparisons of pairs of pixels,
// turned by the direction of its intensity centroid (as ORB's are, with pairs of our own).
class PointDescriptorExtractor {
 public:
  // No point nearer than this to the image's border: patches reach 15 px and smoothing 2 px
  // further. 19 px are ORB's border, with which everything here was measured.
  static constexpr int kBorder = 19;

  // Of an 8-bit image and of itself smoothed, between whose pixels the comparisons are. Keeps
  // references to both.
  PointDescriptorExtractor(const cv::Mat& gray, const cv::Mat& smooth)
      : gray_(gray), smooth_(smooth) {}

  // Direction from a pixel to the intensity centroid of the disc around it, radians in (-pi, pi].
  double Angle(const cv::Point& pixel) const;

  // Of the patch around a pixel, turned by `angle`.
  Descriptor Describe(const cv::Point& pixel, double angle) const;

 private:
  const cv::Mat& gray_;
  const cv::Mat& smooth_;
};

}  // namespace msc_vo
