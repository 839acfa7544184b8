// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>
#include <vector>

#include <opencv2/core.hpp>

#include "msc_vo/frame/frame.h"

namespace msc_vo {

enum class LineDetector {
  kLsd,          ///< line segment detector (von Gioi et al.), used in the paper
  kEdgeDrawing,  ///< EDLines (Akinlar and Topal), several times faster
};

struct LineExtractorOptions {
  LineDetector detector = LineDetector::kEdgeDrawing;
  /// Largest number of lines per image; the longest are kept. Limits the time of description, which
  /// costs more than detection.
  int max_lines = 200;
  /// Shortest line, as a fraction of the image's shorter side: 24 px of 480. The standard deviation
  /// of the direction of such a line is 3.4 degrees (1 px at each end).
  double min_length = 0.05;
};

/// Detects line segments and computes their LBD descriptors.
///
/// Direction convention: the brighter side of a segment is where its ImageLine() is positive, on
/// the right-hand side when moving from start to end in the displayed image (y down). An edge thus
/// has the same direction in every image, as LBD requires.
///
/// Keeps its buffers between calls; not thread-safe.
class LineExtractor {
 public:
  /// The options must be valid (OdometryOptions::IsValid).
  explicit LineExtractor(const LineExtractorOptions& options);
  ~LineExtractor();

  /// Returns the lines of an undistorted 8-bit grey image, longest first, without depth and with
  /// sigma 1. `mask` (CV_8UC1 of the same size, or empty) is zero at pixels without image content,
  /// where segments are clipped. `distance_to_left_out`, of the same size or empty, see
  /// DistanceToMask(): segments are split where their descriptor would see a pixel that is left
  /// out. Throws std::invalid_argument if the image is not CV_8UC1.
  std::vector<LineFeature> Extract(const cv::Mat& image, const cv::Mat& mask = cv::Mat(),
                                   const cv::Mat& distance_to_left_out = cv::Mat());

 private:
  struct Detectors;
  LineExtractorOptions options_;
  std::unique_ptr<Detectors> detectors_;
};

}  // namespace msc_vo
