// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/image_masks.h"

#include <cstdint>
#include <filesystem>
#include <stdexcept>

#include <opencv2/imgproc.hpp>

#include "msc_vo/datasets/image_folder.h"
#include "msc_vo/datasets/image_size_fit.h"
#include "msc_vo/datasets/sequence.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace fs = std::filesystem;

namespace {

// 255 where one of the colour channels is not zero; an alpha channel does not count.
cv::Mat NonZero(const cv::Mat& image) {
  cv::Mat result = cv::Mat::zeros(image.size(), CV_8UC1);
  std::vector<cv::Mat> channels;
  cv::split(image, channels);
  const size_t num_colors = channels.size() < 3 ? 1 : 3;
  for (size_t c = 0; c < num_colors; ++c) result |= channels[c] != 0;
  return result;
}

}  // namespace

ImageMasks::ImageMasks(const std::string& path, LeftOut left_out,
                       const std::vector<SequenceEntry>& entries)
    : path_(path), left_out_(left_out) {
  const char* const zero = left_out == LeftOut::kZero ? ", zero is left out" : "";
  if (IsFolder(path)) {
    ListFolderOfMasks(entries);
    std::uintmax_t num_bytes = 0;
    for (const auto& [name, file] : files_) num_bytes += fs::file_size(file);
    description_ = path +
                   FormatText(", %zu files of %llu bytes", files_.size(),
                              static_cast<unsigned long long>(num_bytes)) +
                   zero;
    return;
  }
  single_ = ReadMask(path);
  description_ = path +
                 FormatText(", %llu bytes", static_cast<unsigned long long>(fs::file_size(path))) +
                 zero;
  if (cv::countNonZero(single_) < static_cast<int>(single_.total())) return;
  throw std::runtime_error(path + ": leaves out every pixel; " +
                           (left_out == LeftOut::kZero
                                ? "pixels that are zero are left out with --mask-zero"
                                : "pixels that are not zero are left out, unless --mask-zero is "
                                  "given"));
}

void ImageMasks::ListFolderOfMasks(const std::vector<SequenceEntry>& entries) {
  for (const std::string& file : ListImages(path_)) files_[fs::path(file).stem().string()] = file;
  size_t num_missing = 0;
  std::string first_missing;
  for (const SequenceEntry& entry : entries) {
    const fs::path color = entry.color_path;
    if (files_.count(color.stem().string()) + files_.count(color.filename().string()) > 0) continue;
    if (num_missing++ == 0) first_missing = entry.color_path;
  }
  if (num_missing == 0) return;
  throw std::runtime_error(
      path_ + ": has no mask for " + first_missing +
      FormatText(" (%zu of %zu images have none); add %s.png, which may be black", num_missing,
                 entries.size(), fs::path(first_missing).stem().string().c_str()));
}

cv::Mat ImageMasks::ReadMask(const std::string& path) const {
  const cv::Mat image = ReadImageFile(path);
  if (image.empty()) {
    throw std::runtime_error(path +
                             ": is damaged or not an image; a mask is an image of the size "
                             "of the colour images");
  }
  const cv::Mat mask = NonZero(image);
  return left_out_ == LeftOut::kZero ? mask == 0 : mask;
}

cv::Mat ImageMasks::Read(const std::string& color_path, const ImageSize& size) const {
  std::string path = path_;
  cv::Mat mask = single_;
  if (mask.empty()) {
    const fs::path color = color_path;
    auto file = files_.find(color.filename().string());
    if (file == files_.end()) file = files_.find(color.stem().string());
    if (file == files_.end()) throw std::runtime_error(path_ + ": has no mask for " + color_path);
    path = file->second;
    mask = ReadMask(path);
  }
  if (HaveSameShape({mask.cols, mask.rows}, size)) return mask;
  throw std::runtime_error(path + FormatText(": is %dx%d, which is not the shape of the images of "
                                             "%dx%d; make masks of the size of the images",
                                             mask.cols, mask.rows, size.width, size.height));
}

cv::Mat ScaledMask(const cv::Mat& mask, const cv::Size& size) {
  if (mask.size() == size) return mask != 0;
  cv::Mat counts;  // of masked pixels above and to the left
  cv::integral(cv::min(mask, 1), counts, CV_32S);
  cv::Mat scaled(size, CV_8UC1);
  for (int y = 0; y < size.height; ++y) {
    const int top = y * mask.rows / size.height;
    const int bottom = ((y + 1) * mask.rows + size.height - 1) / size.height;
    const int *above = counts.ptr<int>(top), *below = counts.ptr<int>(bottom);
    for (int x = 0; x < size.width; ++x) {
      const int left = x * mask.cols / size.width;
      const int right = ((x + 1) * mask.cols + size.width - 1) / size.width;
      const int count = below[right] - above[right] - below[left] + above[left];
      scaled.at<uint8_t>(y, x) = count > 0 ? 255 : 0;
    }
  }
  return scaled;
}

std::shared_ptr<const ImageMasks> OpenMasks(const std::string& path, bool zero,
                                            const SequenceIndex& index) {
  if (path.empty()) return nullptr;
  if (index.camera && IsFolder(path)) {
    throw std::runtime_error(path +
                             ": images of a live camera have no masks; give one image for all");
  }
  return std::make_shared<ImageMasks>(
      path, zero ? ImageMasks::LeftOut::kZero : ImageMasks::LeftOut::kNonZero, index.entries);
}

}  // namespace msc_vo
