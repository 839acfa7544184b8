// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <future>

#include "msc_vo/datasets/rgbd_decoder.h"
#include "msc_vo/sensor/rgbd_image.h"

namespace msc_vo {

// The images of a sequence in order, decoded lazily, one frame ahead of the reader on another
// thread. No more than one decoded image waits, so that memory stays bounded however slow the
// reader is.
class RgbdSource {
 public:
  // Images begin..end-1 of the decoder, which must outlive the source.
  // Throws std::invalid_argument unless 0 <= begin <= end <= decoder.size().
  RgbdSource(const RgbdDecoder& decoder, int begin, int end);

  // Moves the next image into `image`; false at the end. Throws what RgbdDecoder::Decode throws, at
  // the image that caused it, and goes on with the one behind it when called again.
  bool Next(RgbdImage* image);

  // Goes on with image `i`, which must not lie before the next one. What is wrong with an image in
  // between nobody gets to know.
  void SkipTo(int i);

 private:
  void DecodeAhead();

  const RgbdDecoder& decoder_;
  int next_;
  int end_;
  std::future<RgbdImage> ahead_;  // image next_, unless next_ == end_
};

}  // namespace msc_vo
