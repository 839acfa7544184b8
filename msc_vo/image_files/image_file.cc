// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/image_files/image_file.h"

#include <new>
#include <optional>
#include <stdexcept>

#include <opencv2/imgcodecs.hpp>

#include "msc_vo/image_files/image_header.h"
#include "msc_vo/image_files/jpeg_image.h"
#include "msc_vo/image_files/opencv_codecs.h"
#include "msc_vo/image_files/png_image.h"
#include "msc_vo/text/files.h"

namespace msc_vo {

namespace {

// Decodes the kinds of images that nearly all sequences have; empty for others.
cv::Mat DecodeCommonKind(const std::string& bytes, int mode) {
  if (mode == cv::IMREAD_UNCHANGED) {
    const cv::Mat image = DecodePng(bytes);
    return image.empty() ? DecodeJpeg(bytes, JpegChannels::kStored) : image;
  }
  if (mode == (cv::IMREAD_GRAYSCALE | cv::IMREAD_IGNORE_ORIENTATION)) {
    return DecodeJpeg(bytes, JpegChannels::kGray);
  }
  return {};
}

// Decodes the other kinds. Empty if the image is damaged.
cv::Mat DecodeOtherKind(const std::string& bytes, int mode) {
  if (!IsPng(bytes)) return DecodeWithOpenCv(bytes, mode);
  const std::string essential = EssentialPng(bytes);
  return essential.empty() ? cv::Mat() : DecodeWithOpenCv(essential, mode);
}

}  // namespace

cv::Mat DecodeImage(const std::string& bytes, int mode) {
  const std::optional<ImageSize> size = SizeInHeader(bytes);
  if (!size || !IsPlausibleSize(*size, bytes.size()) || IsTruncatedJpeg(bytes)) return {};
  if (IsTiffOfOtherNumbers(bytes)) {
    throw std::runtime_error(
        "TIFF images of unsigned numbers of 32 bits or floating-point numbers of 16 bits are not "
        "read; write unsigned numbers of 16 bits or floating-point numbers of 32 bits");
  }
  try {
    const cv::Mat image = DecodeCommonKind(bytes, mode);
    return image.empty() ? DecodeOtherKind(bytes, mode) : image;
  } catch (const cv::Exception& error) {
    // An image that does not fit into the memory is not damaged: frames must not depend on that.
    if (error.code == cv::Error::StsNoMem) throw std::bad_alloc();
    if (error.code == cv::Error::StsNotImplemented) {
      throw std::runtime_error(
          "OpenCV does not decode images of this format here; EXR needs the environment variable "
          "OPENCV_IO_ENABLE_OPENEXR=1 before the program starts");
    }
    return {};
  }
}

cv::Mat ReadImageFile(const std::string& path) {
  const std::string bytes = ReadFile(path, kMaxImageBytes);
  try {
    return DecodeImage(bytes, cv::IMREAD_UNCHANGED);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(path + ": " + error.what());
  }
}

ImageSize ReadImageSize(const std::string& path) {
  const cv::Mat image = ReadImageFile(path);
  if (image.empty()) {
    throw std::runtime_error(path + ": cannot be read as an image; restore the file");
  }
  return {image.cols, image.rows};
}

}  // namespace msc_vo
