// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/phone_recordings/phone_images.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "msc_vo/image_files/image_file.h"
#include "msc_vo/text/files.h"

namespace msc_vo {

namespace {

cv::Mat ReadImage(const std::string& path) {
  cv::Mat image = ReadImageFile(path);
  if (image.empty()) {
    throw std::runtime_error(path + ": is damaged, truncated or not an image; restore the file");
  }
  return image;
}

}  // namespace

PhoneImages::PhoneImages(std::vector<PhoneImage> images, std::shared_ptr<const CommonCamera> camera,
                         std::shared_ptr<const VideoImages> video, const ConfidenceValues& values,
                         DepthConfidence least)
    : images_(std::move(images)),
      camera_(std::move(camera)),
      video_(std::move(video)),
      values_(values),
      least_(least) {}

StoredImage PhoneImages::ReadColor(int index) const {
  const PhoneImage& image = images_.at(static_cast<size_t>(index));
  if (!video_ && !Resamples(index)) return {ReadFile(image.color_path, kMaxImageBytes), {}};
  cv::Mat pixels;
  if (video_) {
    pixels = video_->Read(image.video_number);
  } else {
    // The file may ask for a rotation for display, which the intrinsics do not follow.
    pixels = DecodeImage(ReadFile(image.color_path, kMaxImageBytes),
                         cv::IMREAD_COLOR | cv::IMREAD_IGNORE_ORIENTATION);
    if (pixels.empty()) {
      throw std::runtime_error(image.color_path +
                               ": is damaged, truncated or not an image; restore the file");
    }
  }
  if (Resamples(index)) pixels = camera_->Resample(index, pixels, cv::INTER_LINEAR);
  return {"", pixels};
}

cv::Mat PhoneImages::ConfidentDepth(const PhoneImage& image, int* num_depths,
                                    int* num_removed) const {
  cv::Mat depth = ReadImage(image.depth_path).clone();
  if (depth.type() != CV_16UC1) {
    throw std::runtime_error(image.depth_path +
                             ": depth images of this layout need 1 channel of 16 bits, in "
                             "millimetres; export the raw data again");
  }
  *num_depths = cv::countNonZero(depth);
  *num_removed = 0;
  if (image.confidence_path.empty() || least_ == DepthConfidence::kLow) return depth;
  try {
    *num_removed = RemoveUncertainDepth(ReadImage(image.confidence_path), values_, least_, &depth);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(image.confidence_path + ": " + error.what());
  }
  return depth;
}

StoredImage PhoneImages::ReadDepth(int index) const {
  const PhoneImage& image = images_.at(static_cast<size_t>(index));
  const bool is_as_stored = image.confidence_path.empty() || least_ == DepthConfidence::kLow;
  if (is_as_stored && !Resamples(index)) return {ReadFile(image.depth_path, kMaxImageBytes), {}};
  int num_depths = 0, num_removed = 0;
  cv::Mat depth = ConfidentDepth(image, &num_depths, &num_removed);
  if (Resamples(index)) depth = camera_->Resample(index, depth, cv::INTER_NEAREST);
  return {"", depth};
}

std::string PhoneImages::Settings() const {
  return std::string("least confidence ") + ToString(least_);
}

cv::Mat PhoneImages::AlignMask(int index, const cv::Mat& mask) const {
  constexpr int kLeftOut = 255;
  return Resamples(index) ? camera_->Resample(index, mask, cv::INTER_NEAREST, kLeftOut) : mask;
}

double PhoneImages::RemovedDepthRatio() const {
  constexpr size_t kNumImages = 10;
  const size_t step = std::max<size_t>(1, images_.size() / kNumImages);
  double sum_depths = 0.0, sum_removed = 0.0;
  for (size_t i = 0; i < images_.size(); i += step) {
    int num_depths = 0, num_removed = 0;
    try {
      ConfidentDepth(images_[i], &num_depths, &num_removed);
    } catch (const std::runtime_error&) {  // a damaged image is reported when it is used
      continue;
    }
    sum_depths += num_depths;
    sum_removed += num_removed;
  }
  return sum_depths > 0.0 ? sum_removed / sum_depths : 0.0;
}

}  // namespace msc_vo
