// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "msc_vo/datasets/rgbd_decoder.h"
#include "msc_vo/diagnosis/finding.h"
#include "msc_vo/sensor/byte_order.h"

namespace msc_vo {

/// Statistics of one depth image.
struct DepthQuality {
  double valid = 0.0;         ///< ratio of pixels with a depth
  std::vector<float> sample;  ///< metres, valid depths of a regular subset of the pixels
};

/// Units of the depth values of a sequence.
struct DepthUnits {
  double per_metre = 0.0;
  bool are_floats = false;  ///< floating-point numbers, whose units have an option of their own

  /// The option that sets them.
  const char* Option() const { return are_floats ? "camera.float_depth_scale" : "depth_scale"; }
  /// Units per metre of common sources.
  const std::vector<double>& CommonScales() const;
};

/// Returns the units of the first depth image that can be decoded.
DepthUnits FindDepthUnits(const RgbdDecoder& decoder);

/// Measures a depth image in metres (CV_32FC1, 0: none).
DepthQuality MeasureDepth(const cv::Mat& depth);

/// Range of the depths (wrong units show here), ratio of valid pixels, byte order, and a value that
/// stands for no measurement.
void AddDepthFindings(const std::vector<DepthQuality>& images, const ByteOrder& byte_order,
                      const DepthUnits& units, Findings* findings);

}  // namespace msc_vo
