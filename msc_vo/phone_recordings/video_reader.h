// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <functional>
#include <memory>
#include <string>

#include <opencv2/core.hpp>

namespace msc_vo {

/// A video file that is decoded from its begin. The one implementation needs OpenCV's video
/// library, which programs load for the recordings that need it.
class VideoReader {
 public:
  virtual ~VideoReader() = default;

  /// Begins again at image 0. Returns false if the file cannot be decoded.
  virtual bool Open(const std::string& path) = 0;
  /// Number of images that the header of the file gives; it may be an estimate, or 0.
  virtual int NumImagesInHeader() const = 0;
  /// Images per second; 0: not given.
  virtual double FrameRate() const = 0;
  /// Decodes the next image. Returns false at the end and if it is damaged.
  virtual bool Skip() = 0;
  /// Returns the image that Skip() decoded last, CV_8UC3 (BGR), with the rows and columns of the
  /// sensor: a rotation for display that the file may ask for is not applied.
  virtual cv::Mat Image() = 0;
};

/// Makes a VideoReader. Throws std::runtime_error with the fix if there is none.
using MakeVideoReader = std::function<std::unique_ptr<VideoReader>()>;

}  // namespace msc_vo
