// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <opencv2/core.hpp>

#include "msc_vo/sensor/depth_noise.h"

namespace msc_vo {

/// Returns the depth image (CV_32FC1, metres) without flying pixels: beside depth edges, sensors
/// without a disparity measure a mixture of both surfaces. A pixel is kept if at least four of its
/// eight neighbours agree with it, given `noise`, and otherwise set to 0.
cv::Mat RemoveFlyingPixels(const cv::Mat& depth, const DepthNoise& noise);

}  // namespace msc_vo
