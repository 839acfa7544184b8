// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include <opencv2/core.hpp>

namespace msc_vo {

/// cv::imdecode() and cv::imencode(), from OpenCV's library of image formats, which is loaded by
/// the first call: with Debian's OpenCV it brings 120 other libraries (GDAL and those of all its
/// formats), which take 40 MiB and 0.07 s of every program that is linked with it.
/// Both throw std::runtime_error if it cannot be loaded. DecodeWithOpenCv() returns an empty image
/// or throws cv::Exception for a damaged file, EncodeWithOpenCv() returns an empty string for an
/// image that the format cannot hold.
cv::Mat DecodeWithOpenCv(const std::string& bytes, int mode);
std::string EncodeWithOpenCv(const std::string& extension, const cv::Mat& image,
                             const std::vector<int>& parameters);

}  // namespace msc_vo
