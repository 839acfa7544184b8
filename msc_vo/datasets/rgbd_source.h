// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <future>

#include "msc_vo/datasets/rgbd_decoder.h"
#include "msc_vo/sensor/rgbd_image.h"

namespace msc_vo {

/// Reads the images of a sequence in order and decodes one image ahead of the reader on another
/// thread. At most one decoded image is buffered, so memory stays bounded.
class RgbdSource {
 public:
  /// Reads images begin..end-1 of the decoder, which must outlive the source.
  /// Throws std::invalid_argument unless 0 <= begin <= end <= decoder.size().
  RgbdSource(const RgbdDecoder& decoder, int begin, int end);

  /// Moves the next image into `image`; returns false at the end. Rethrows the exception of
  /// RgbdDecoder::Decode() for this image; the next call continues with the following image.
  bool Next(RgbdImage* image);

  /// Continues with image `i`. Errors in skipped images are not reported.
  /// Throws std::invalid_argument unless next <= i <= end.
  void SkipTo(int i);

 private:
  void DecodeAhead();

  const RgbdDecoder& decoder_;
  int next_;
  int end_;
  std::future<RgbdImage> ahead_;  // image next_, unless next_ == end_
};

}  // namespace msc_vo
