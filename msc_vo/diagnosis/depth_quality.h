// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "msc_vo/diagnosis/finding.h"
#include "msc_vo/sensor/byte_order.h"

namespace msc_vo {

/// Statistics of one depth image.
struct DepthQuality {
  double valid = 0.0;         ///< ratio of pixels with a depth
  std::vector<float> sample;  ///< metres, valid depths of a regular subset of the pixels
};

/// Measures a depth image in metres (CV_32FC1, 0: none).
DepthQuality MeasureDepth(const cv::Mat& depth);

/// Range of the depths (a wrong depth scale shows here), ratio of valid pixels and byte order.
void AddDepthFindings(const std::vector<DepthQuality>& images, const ByteOrder& byte_order,
                      double depth_scale, Findings* findings);

}  // namespace msc_vo
