// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include <opencv2/core.hpp>

namespace msc_vo {

/// The channels that an image is decoded to.
enum class JpegChannels { kGray, kStored };

/// Decodes a JPEG file, without rotating it, to its grey values or to grey or colour (blue first)
/// as it is stored. The missing part of a truncated file is grey. Returns an empty image for files
/// of four colours, damaged ones and other formats.
cv::Mat DecodeJpeg(const std::string& bytes, JpegChannels channels);

/// Encodes a grey image of 8 bits; `quality` is 1 to 100. Throws std::runtime_error if it cannot.
std::string EncodeJpeg(const cv::Mat& gray, int quality);

}  // namespace msc_vo
