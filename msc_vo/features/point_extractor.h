// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "msc_vo/map/frame.h"

namespace msc_vo {

struct PointExtractorOptions {
  int num_points = 1000;  // per image, at most; the levels' shares fall with their scale
  // Of the pyramid; levels that become too small are left out. 1.2^8 = 4.3: a point is found again
  // from four times the distance.
  int num_levels = 8;
  int fast_threshold = 20;     // grey values, of a FAST corner
  int min_fast_threshold = 7;  // grey values, in cells that have no corner at fast_threshold

  bool IsValid(std::string* error) const;
};

// FAST corners over an image pyramid, evenly spread, with orientation and descriptor.
// Keeps its buffers between calls; not for use from several threads at once.
class PointExtractor {
 public:
  // Throws std::invalid_argument on options that are not valid.
  explicit PointExtractor(const PointExtractorOptions& options);

  // Points of an 8-bit grey image, without depth. Pixels are those of the image given; sigma is the
  // scale of the point's level (1 on level 0). Ordered by level, then by choice within the level.
  // Throws std::invalid_argument if the image is not CV_8UC1.
  std::vector<PointFeature> Extract(const cv::Mat& gray);

  // The same in steps: SetImage() makes the pyramid and returns how many levels it has; then the
  // levels, which share nothing, in any order and from several threads.
  int SetImage(const cv::Mat& gray);
  std::vector<PointFeature> ExtractLevel(int level);

 private:
  struct Level {
    cv::Mat image;
    cv::Mat smooth;
    int num_points = 0;  // at most
    double scale = 1.0;
  };

  PointExtractorOptions options_;
  std::vector<Level> levels_;
};

}  // namespace msc_vo
