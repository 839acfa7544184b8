// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include <opencv2/core.hpp>

namespace msc_vo {

// The image that the contents of a file are; `mode` is one of OpenCV's cv::ImreadModes. Empty if
// they are damaged or no image.
cv::Mat DecodeImage(const std::string& bytes, int mode);

// The image of a file, with its own channels and bits; empty if it is damaged or no image. Throws
// std::runtime_error, naming the file, if it cannot be read.
cv::Mat ReadImageFile(const std::string& path);

}  // namespace msc_vo
