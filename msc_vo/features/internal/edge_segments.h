// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include "msc_vo/features/internal/edge_drawing.h"
#include "msc_vo/features/internal/image_gradient.h"
#include "msc_vo/geometry/line_segment.h"

namespace msc_vo {

/// Detects line segments in chains of edge pixels (EDLines, Akinlar and Topal 2011): each chain is
/// split into pieces that a straight line fits within one pixel. A piece is accepted if the
/// gradients along it agree with its direction so well that less than one such piece is expected in
/// an image of noise (Desolneux, Moisan and Morel 2000).
class EdgeSegmentDetector {
 public:
  /// Returns the segments of an 8-bit grey image (CV_8UC1), in pixels; their direction has no
  /// meaning. The reference is valid until the next call.
  const std::vector<LineSegment2>& Detect(const cv::Mat& gray);

 private:
  class PixelMoments;
  struct FittedLine;

  void FitChain(const EdgeDrawing::Chain& chain);
  int Extend(int chain_end, int end, PixelMoments moments, FittedLine* line) const;
  bool IsMeaningful(int begin, int end, const Eigen::Vector2d& direction) const;
  Eigen::Vector2d PixelAt(int index) const;

  ImageGradient gradient_;
  EdgeDrawing drawing_;
  std::vector<LineSegment2> segments_;
  double min_information_ = 0.0;  // nats that an accepted piece needs, see IsMeaningful
  int min_pixels_ = 0;            // smallest number of pixels that can reach min_information_
};

}  // namespace msc_vo
