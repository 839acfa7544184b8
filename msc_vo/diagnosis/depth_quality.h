// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "msc_vo/diagnosis/finding.h"

namespace msc_vo {

/// Statistics of one depth image.
struct DepthQuality {
  double valid = 0.0;         ///< ratio of pixels with a depth
  double saturated = 0.0;     ///< ratio of pixels at the largest raw value, 65535
  std::vector<float> sample;  ///< metres, valid depths of a regular subset of the pixels
  /// Median of |a - b| / (a + b) over neighbouring raw values a and b that differ: as they are, and
  /// with the two bytes of each value swapped. Zero without such neighbours.
  double roughness = 0.0;
  double swapped_roughness = 0.0;
};

/// Measures a depth image in metres (CV_32FC1, 0: none) that has `depth_scale` raw units per metre.
DepthQuality MeasureDepth(const cv::Mat& depth, double depth_scale);

/// Range of the depths (a wrong depth scale shows here), ratio of valid pixels, byte order and
/// saturation.
void AddDepthFindings(const std::vector<DepthQuality>& images, double depth_scale,
                      Findings* findings);

}  // namespace msc_vo
