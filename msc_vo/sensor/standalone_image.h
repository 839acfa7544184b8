// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <opencv2/core.hpp>

#include "msc_vo/sensor/rgbd_image.h"

namespace msc_vo {

/// Returns the image, copied if it is a view of a larger matrix or has gaps between its rows. At
/// the borders of a view, filters of OpenCV (GaussianBlur, Sobel, dilate) read the pixels around
/// it, and they round differently.
cv::Mat StandaloneImage(const cv::Mat& image);

/// Returns the image with standalone pixels.
RgbdImage StandaloneImages(RgbdImage image);

}  // namespace msc_vo
