// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "msc_vo/features/line_merging.h"
#include "msc_vo/map/frame.h"

namespace msc_vo {

enum class LineDetector {
  kLsd,          // line segment detector of von Gioi et al.: the paper's
  kEdgeDrawing,  // EDLines of Akinlar and Topal: several times faster
};

struct LineExtractorOptions {
  LineDetector detector = LineDetector::kEdgeDrawing;
  // Lines kept, the longest: description costs more than detection, and the paper's scenes have
  // fewer.
  int max_lines = 200;
  // Shortest line, as a fraction of the image's shorter side: 24 px of 480. The direction of such a
  // line is known to 3.4 degrees (1 px at each end); a shorter one constrains nothing.
  double min_length = 0.05;
  LineMergingOptions merging;

  bool IsValid(std::string* error) const;
};

// Line segments with LBD descriptors.
//
// Direction convention: the brighter side of a segment is where its ImageLine() is positive (on the
// right-hand side of someone who walks from start to end in the image as it is seen, y down). The
// same edge so has the same direction in every image; LBD depends on it.
//
// Keeps its buffers between calls; not for use from several threads at once.
class LineExtractor {
 public:
  // Throws std::invalid_argument on options that are not valid.
  explicit LineExtractor(const LineExtractorOptions& options);
  ~LineExtractor();

  // Lines of an 8-bit grey image without lens distortion, longest first, without depth; sigma is 1.
  // `mask` (CV_8UC1 of the same size, or empty) is zero where the image shows nothing: segments are
  // cut there. Throws std::invalid_argument if the image is not CV_8UC1.
  std::vector<LineFeature> Extract(const cv::Mat& gray, const cv::Mat& mask = cv::Mat());

 private:
  struct Detectors;
  LineExtractorOptions options_;
  std::unique_ptr<Detectors> detectors_;
};

}  // namespace msc_vo
