// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include <opencv2/core.hpp>

namespace msc_vo {

/// Decodes a PNG file as cameras and datasets write them: grey of 8 or 16 bits, or colour of 8 bits
/// with or without an alpha channel (in OpenCV's order, blue first), without palette, transparent
/// colour and interlacing. Returns an empty image for every other file, damaged ones included.
cv::Mat DecodePng(const std::string& bytes);

bool IsPng(const std::string& bytes);

/// Returns a PNG file without the chunks that do not change its pixels. Empty if the file ends too
/// early or the checksum of another chunk does not match. OpenCV decodes the result as it does the
/// file, but libpng prints no warnings.
std::string EssentialPng(const std::string& bytes);

}  // namespace msc_vo
