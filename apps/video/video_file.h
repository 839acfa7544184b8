// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include <opencv2/core.hpp>

#include "msc_vo/phone_recordings/video_reader.h"

namespace msc_vo {

/// A video file that is written. The one implementation is a module that is loaded for runs with a
/// video: OpenCV's video library brings some 200 other libraries.
class VideoFile {
 public:
  virtual ~VideoFile() = default;

  /// Begins the file. Returns false if it cannot be written or nothing can encode it.
  virtual bool Open(const std::string& path, double frame_rate, const cv::Size& size) = 0;

  /// Adds an image, CV_8UC3 of the size of the video.
  virtual void Write(const cv::Mat& image) = 0;

  virtual void Close() = 0;

  /// Number of images that a file holds; 0 if it cannot be read.
  virtual int CountImages(const std::string& path) const = 0;
};

inline constexpr char kVideoModule[] = "msc_vo_video.so";
/// The function of the module that makes one; the caller owns the result.
using MakeVideoFile = VideoFile* (*)();
inline constexpr char kMakeVideoFile[] = "msc_vo_make_video_file";
/// The same for reading.
using MakeVideoReaderOfModule = VideoReader* (*)();
inline constexpr char kMakeVideoReader[] = "msc_vo_make_video_reader";

}  // namespace msc_vo
