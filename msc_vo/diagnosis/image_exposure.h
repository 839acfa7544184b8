// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "msc_vo/diagnosis/finding.h"

namespace msc_vo {

/// Grey levels and sharpness of one colour image, and whether there is depth instead.
struct ImageExposure {
  double mean = 0.0;          ///< grey levels, 0..255
  double contrast = 0.0;      ///< standard deviation of the grey levels
  double bright_level = 0.0;  ///< grey level that 5 % of the pixels exceed
  double saturated = 0.0;     ///< ratio of pixels at 250 grey levels or more
  /// Median width of the strongest edges, pixels: height of the edge over its steepest slope. Two
  /// for a step, 2.5 sigma for an edge blurred by sigma pixels. Zero if there are too few edges.
  double edge_width = 0.0;
  double measured_depth = 0.0;  ///< ratio of the pixels of the depth image with a depth
};

/// Measures an 8-bit grey image; the caller sets `measured_depth`.
ImageExposure MeasureExposure(const cv::Mat& gray);

/// Black, white, over-exposed, dim and blurred images. Uniform images are an error only if they
/// have no depth: planes of depth images give poses without colour. `width` is that of the images,
/// pixels.
void AddExposureFindings(const std::vector<ImageExposure>& images, int width, Findings* findings);

}  // namespace msc_vo
