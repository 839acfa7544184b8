// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>

#include <opencv2/core.hpp>

#include "msc_vo/sensor/depth_sensor.h"

namespace msc_vo {

/// What the noise of one depth image says about its sensor. The noise is measured by the second
/// differences of inverse depth along the rows, which are zero on every plane.
struct DepthStatistics {
  int num_samples = 0;
  /// Standard deviation of inverse depth over neighbouring pixels, and over the eightieth part of
  /// the width of the image, 1/metres. Equal if pixels are independent.
  double near_noise = 0.0;
  double far_noise = 0.0;
  /// Usual difference between adjacent values of inverse depth in the farther half of the image,
  /// 1/metres: the resolution of disparity, if the sensor measures one.
  double step = 0.0;
  /// Exponent of the standard deviation of depth as a power of depth: 2 if disparity is measured,
  /// at most 1 if range is. None if the depths of the image are too similar.
  std::optional<double> exponent;
};

/// `depth`: CV_32FC1, metres, 0 where nothing was measured.
DepthStatistics MeasureDepthStatistics(const cv::Mat& depth);

/// Returns the most likely sensor: structured light unless there is evidence for another one, and
/// kAuto if the image is inconclusive.
DepthSensor ClassifyDepthSensor(const DepthStatistics& statistics);

}  // namespace msc_vo
