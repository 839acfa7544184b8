// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/rgbd_source.h"

#include <stdexcept>
#include <string>

namespace msc_vo {

RgbdSource::RgbdSource(const RgbdDecoder& decoder, int begin, int end)
    : decoder_(decoder), next_(begin), end_(end) {
  if (begin < 0 || begin > end || end > decoder.size()) {
    throw std::invalid_argument("images " + std::to_string(begin) + " to " + std::to_string(end) +
                                " requested from a sequence of " + std::to_string(decoder.size()));
  }
  DecodeAhead();
}

void RgbdSource::DecodeAhead() {
  if (next_ == end_) return;
  ahead_ = std::async(std::launch::async, [this, i = next_] { return decoder_.Decode(i); });
}

bool RgbdSource::Next(RgbdImage* image) {
  if (next_ == end_) return false;
  std::future<RgbdImage> current = std::move(ahead_);
  current.wait();
  ++next_;
  DecodeAhead();
  *image = current.get();
  return true;
}

void RgbdSource::SkipTo(int i) {
  if (i < next_ || i > end_) {
    throw std::invalid_argument("image " + std::to_string(i) + " requested, but the next one is " +
                                std::to_string(next_) + " of " + std::to_string(end_));
  }
  if (i == next_) return;
  ahead_.wait();
  next_ = i;
  DecodeAhead();
}

}  // namespace msc_vo
