// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string_view>

#include <opencv2/core.hpp>

namespace msc_vo {

/// Decodes a 16-bit depth image of the codec RVL (Wilson, "Fast Lossless Depth Image Compression",
/// 2017) with its width and height in front, as compressed_depth_image_transport writes it. Throws
/// std::runtime_error if it is damaged.
cv::Mat DecodeRvl(std::string_view bytes);

}  // namespace msc_vo
