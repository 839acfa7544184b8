// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include <opencv2/core.hpp>

namespace msc_vo {

/// Size of an image, pixels.
struct ImageSize {
  int width = 0;
  int height = 0;
};

/// Decodes the contents of an image file (PNG, JPEG, BMP, TIFF, EXR, WebP, PBM, PGM or PPM); `mode`
/// is one of OpenCV's cv::ImreadModes. Returns an empty image if the contents are damaged or no
/// such image, and without decoding it if the header claims more pixels than the file can hold.
/// Throws std::runtime_error if the file needs OpenCV's image formats and these are not installed,
/// is a TIFF of numbers that OpenCV does not read, or is EXR without OPENCV_IO_ENABLE_OPENEXR=1 in
/// the environment, which the command msc_vo sets, and std::bad_alloc without enough memory, which
/// does not make an image damaged.
cv::Mat DecodeImage(const std::string& bytes, int mode);

/// Reads an image with its original channels and bit depth. Returns an empty image if the file is
/// damaged or no image. Throws std::runtime_error, naming the file, if it cannot be read.
cv::Mat ReadImageFile(const std::string& path);

/// Returns the size of an image. Throws std::runtime_error, naming the file, if it cannot be read
/// or is not an image.
ImageSize ReadImageSize(const std::string& path);

}  // namespace msc_vo
