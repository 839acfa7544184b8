// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/phone_recordings/video_images.h"

#include <cstdint>
#include <stdexcept>
#include <utility>

#include "msc_vo/text/files.h"

namespace msc_vo {

VideoImages::VideoImages(std::string path, const MakeVideoReader& make_reader)
    : path_(std::move(path)) {
  const std::string problem = FileProblem(path_, UINTMAX_MAX);
  if (!problem.empty()) throw std::runtime_error(path_ + ": " + problem + "; restore the video");
  if (!make_reader) {
    throw std::runtime_error(path_ +
                             ": videos are read by the command msc_vo; msc_vo record makes a "
                             "folder of images of the recording");
  }
  try {
    reader_ = make_reader();
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(path_ + ": " + error.what());
  }
  Reopen();
}

void VideoImages::Reopen() const {
  next_ = 0;
  current_ = -1;
  if (reader_->Open(path_)) return;
  throw std::runtime_error(path_ +
                           ": cannot be decoded as a video; copy the file again, and check that "
                           "OpenCV has FFmpeg, as that of Debian has");
}

double VideoImages::FrameRate() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return reader_->FrameRate();
}

bool VideoImages::HasImages(int count, int* num_images) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  *num_images = reader_->NumImagesInHeader();
  if (*num_images == count) return true;
  Reopen();
  while (reader_->Skip()) ++next_;
  *num_images = next_;
  Reopen();
  return *num_images == count;
}

cv::Mat VideoImages::Read(int number) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (number == current_) return image_;
  if (number < next_) Reopen();
  while (next_ <= number) {
    if (!reader_->Skip()) {
      current_ = -1;
      throw std::runtime_error(path_ + ": image " + std::to_string(next_) +
                               " cannot be decoded; copy the video again");
    }
    ++next_;
  }
  image_ = reader_->Image().clone();
  current_ = image_.empty() ? -1 : number;
  if (image_.empty()) {
    throw std::runtime_error(path_ + ": image " + std::to_string(number) + " is empty");
  }
  return image_;
}

}  // namespace msc_vo
