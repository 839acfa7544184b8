// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <opencv2/core.hpp>

#include "msc_vo/sensor/rgbd_image.h"

namespace msc_vo {

/// Removes the depths at pixels that the mask of the image leaves out: of `depth`, and of
/// `recorded_depth` if it has the size of the mask. The pixels of the matrices, which others may
/// share, stay. Does nothing without a mask.
void RemoveMaskedDepth(RgbdImage* image);

/// Distance of each pixel from the nearest one that `mask` (CV_8UC1, not zero: left out) leaves
/// out, pixels; CV_32FC1. Empty without a mask.
cv::Mat DistanceToMask(const cv::Mat& mask);

}  // namespace msc_vo
