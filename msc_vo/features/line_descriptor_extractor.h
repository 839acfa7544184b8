// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <opencv2/core.hpp>

#include "msc_vo/geometry/line_segment.h"
#include "msc_vo/map/frame.h"

namespace msc_vo {

// The line band descriptor LBD (Zhang and Koch 2013) in binary form.
//
// The region of a line is split into 9 bands along it. In every row of a band the gradients towards
// the bright side, away from it, along the line and against it are summed; a band is described by
// the means and the standard deviations of the four sums over its rows and those of the bands
// beside it. Each bit tells which of two bands has the larger of one of these eight numbers, so
// that neither contrast nor brightness matters.
//
// Computed in the image of half the size, where a band is 4 pixels wide: the region is 72 px of the
// image wide (63 with the original 7 px in full size), at a quarter of the time and, measured, with
// as many correct nearest neighbours.
//
// Keeps its buffers between calls; not for use from several threads at once.
class LineDescriptorExtractor {
 public:
  // The image of the lines to come, CV_8UC1, not empty.
  void SetImage(const cv::Mat& gray);

  // `segment` lies in the image (pixels) and has a length; its direction matters (see
  // LineExtractor).
  Descriptor Describe(const LineSegment2& segment) const;

 private:
  // The four sums over one row of the region.
  Eigen::Array4f SumRow(const Eigen::Vector2d& first, const Eigen::Vector2d& direction,
                        int steps) const;

  cv::Mat half_;
  cv::Mat padded_;      // half_ with a margin, so that no region reaches beyond it
  cv::Mat gradient_x_;  // of padded_, CV_16SC1
  cv::Mat gradient_y_;
  cv::Mat both_;      // CV_16SC2
  cv::Mat gradient_;  // CV_32FC2
};

}  // namespace msc_vo
