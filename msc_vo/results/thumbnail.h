// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include <opencv2/core.hpp>

#include "msc_vo/sensor/rgbd_image.h"

namespace msc_vo {

/// The image, reduced to a width of at most 320 pixels, as a JPEG file. `gray`: CV_8UC1.
std::string EncodeThumbnail(const cv::Mat& gray);

/// The grey image, reduced to at most 160 x 160 pixels, as a JPEG file for a map file: of at most
/// 2000 bytes, which fit into a page of that file. Pixels that the mask leaves out are black.
std::string EncodeMapImage(const RgbdImage& image);

}  // namespace msc_vo
