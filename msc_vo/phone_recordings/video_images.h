// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>
#include <mutex>
#include <string>

#include <opencv2/core.hpp>

#include "msc_vo/phone_recordings/video_reader.h"

namespace msc_vo {

/// The images of a video by their number. Positions in compressed video are not exact, so images
/// are decoded one after the other: reading them in order is fast, an earlier one begins again. One
/// decoded image is kept. Thread-safe.
class VideoImages {
 public:
  /// Opens the video. Throws std::runtime_error, naming the file, if it cannot be decoded.
  VideoImages(std::string path, const MakeVideoReader& make_reader);

  const std::string& path() const { return path_; }
  double FrameRate() const;
  /// Whether the video holds `count` images: its header says so, or else all are decoded and
  /// counted. `num_images` is the number found.
  bool HasImages(int count, int* num_images) const;
  /// Returns image `number`, CV_8UC3 (BGR). Throws std::runtime_error, naming the file and the
  /// number, if it is damaged or there is no such image.
  cv::Mat Read(int number) const;

 private:
  void Reopen() const;

  std::string path_;
  mutable std::mutex mutex_;
  std::unique_ptr<VideoReader> reader_;
  mutable int next_ = 0;      // image that Skip() decodes next
  mutable int current_ = -1;  // number of image_; -1: none
  mutable cv::Mat image_;
};

}  // namespace msc_vo
