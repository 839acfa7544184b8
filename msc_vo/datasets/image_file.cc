// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/image_file.h"

#include <optional>
#include <stdexcept>

#include <opencv2/imgcodecs.hpp>

#include "msc_vo/datasets/image_header.h"
#include "msc_vo/text/files.h"

namespace msc_vo {

cv::Mat DecodeImage(const std::string& bytes, int mode) {
  const std::optional<ImageSize> size = SizeInHeader(bytes);
  if (!size || !IsPlausibleSize(*size, bytes.size())) return {};
  const cv::Mat buffer(1, static_cast<int>(bytes.size()), CV_8UC1, const_cast<char*>(bytes.data()));
  try {
    return cv::imdecode(buffer, mode);
  } catch (const cv::Exception&) {
    return {};
  }
}

cv::Mat ReadImageFile(const std::string& path) {
  return DecodeImage(ReadFile(path, kMaxImageBytes), cv::IMREAD_UNCHANGED);
}

ImageSize ReadImageSize(const std::string& path) {
  const cv::Mat image = ReadImageFile(path);
  if (image.empty()) {
    throw std::runtime_error(path + ": cannot be read as an image; restore the file");
  }
  return {image.cols, image.rows};
}

}  // namespace msc_vo
