// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <opencv2/core.hpp>

#include "msc_vo/frame/frame.h"
#include "msc_vo/geometry/line_segment.h"

namespace msc_vo {

/// Binary line band descriptor (LBD, Zhang and Koch 2013).
///
/// The support region of a line is divided into 9 bands parallel to it. In every row of a band the
/// gradients towards the bright side, away from it, along the line and against it are summed; a
/// band is described by the means and standard deviations of the four sums over its rows and those
/// of the adjacent bands. Each bit is a comparison of one of these eight numbers between two bands,
/// so the descriptor is invariant to contrast and brightness.
///
/// The descriptor is computed in the image at half size with bands 4 pixels wide: the region is
/// 72 px wide in the full image (63 px in the original), at a quarter of the time and with equal
/// matching performance, see docs/lab/features.md.
///
/// Keeps its buffers between calls; not thread-safe.
class LineDescriptorExtractor {
 public:
  /// Width of the region of a line, pixels of the full image.
  static constexpr int kWidth = 72;

  /// Sets the image that the lines lie in, CV_8UC1, not empty.
  void SetImage(const cv::Mat& gray);

  /// `segment` must lie in the image (pixels) and have a positive length. The descriptor depends on
  /// its direction (see LineExtractor).
  Descriptor Describe(const LineSegment2& segment) const;

 private:
  Eigen::Array4f SumRow(const Eigen::Vector2d& first, const Eigen::Vector2d& direction,
                        int steps) const;

  cv::Mat half_;
  cv::Mat padded_;      // half_ with a margin that contains the regions of all lines
  cv::Mat gradient_x_;  // of padded_, CV_16SC1
  cv::Mat gradient_y_;
  cv::Mat both_;      // CV_16SC2
  cv::Mat gradient_;  // CV_32FC2
};

}  // namespace msc_vo
