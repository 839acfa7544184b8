// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include <opencv2/core.hpp>

namespace msc_vo {

/// An image as its source stores it: either an encoded file or pixels.
struct StoredImage {
  std::string bytes;  ///< PNG or JPEG; empty: `pixels` has the image
  /// Colour: 8 bits, 1, 3 (BGR) or 4 channels. Depth: CV_16UC1 in raw units, 0 for no measurement,
  /// or CV_32FC1 in metres, where everything but finite positive values is no measurement.
  cv::Mat pixels;
};

/// The images of a recording in one file. Images are decoded on demand. Thread-safe.
class ImageContainer {
 public:
  virtual ~ImageContainer() = default;

  /// Both return the image at a position of the container, SequenceEntry::color_index or
  /// depth_index, and throw std::runtime_error if it is damaged.
  virtual StoredImage ReadColor(int index) const = 0;
  virtual StoredImage ReadDepth(int index) const = 0;

  /// Settings of the source that decide on the images, "least confidence medium"; empty: none.
  virtual std::string Settings() const { return ""; }

  /// Returns a mask of colour image `index` as recorded for the image that ReadColor() returns,
  /// which has the same size and may be resampled. CV_8UC1.
  virtual cv::Mat AlignMask(int /*index*/, const cv::Mat& mask) const { return mask; }
};

}  // namespace msc_vo
