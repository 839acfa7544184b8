// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/features/fast_corners.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <utility>

namespace msc_vo {

namespace {

// Thirty-two pixels at once. Where the processor has AVX2 they are one vector, elsewhere two: the
// functions over rows are compiled for both, and the loader chooses, but for ThreadSanitizer, which
// is not ready when the loader asks. What works on integers alone gives the same numbers.
using Pixels [[gnu::vector_size(32)]] = uint8_t;
constexpr int kLanes = sizeof(Pixels), kWord = sizeof(uint64_t);
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_THREAD__)
#define MSC_VO_AVX2_IF_PRESENT [[gnu::target_clones("avx2", "default")]]
#else
#define MSC_VO_AVX2_IF_PRESENT
#endif
// Vectors are handed over between the functions below, which are inlined and need no convention.
#pragma GCC diagnostic ignored "-Wpsabi"

[[gnu::always_inline]] inline Pixels Load(const uint8_t* from) {
  Pixels pixels;
  std::memcpy(&pixels, from, sizeof(pixels));
  return pixels;
}
[[gnu::always_inline]] inline void Store(const Pixels& pixels, uint8_t* to) {
  std::memcpy(to, &pixels, sizeof(pixels));
}
[[gnu::always_inline]] inline Pixels Min(const Pixels& a, const Pixels& b) { return a < b ? a : b; }
[[gnu::always_inline]] inline Pixels Max(const Pixels& a, const Pixels& b) { return a > b ? a : b; }

constexpr int kCircle = 16;

// Where the pixels of the circle are from its centre, clockwise from above.
using Circle = std::array<std::ptrdiff_t, kCircle>;
Circle CircleOffsets(std::ptrdiff_t step) {
  return {-3 * step, -3 * step + 1, -2 * step + 2, -step + 3,
          3,         step + 3,      2 * step + 2,  3 * step + 1,
          3 * step,  3 * step - 1,  2 * step - 2,  step - 3,
          -3,        -step - 3,     -2 * step - 2, -3 * step - 1};
}

// Two arcs of nine that begin side by side, at an even place and the one behind it, have the eight
// pixels between their ends in common: what all of those exceed and one of the two ends.
[[gnu::always_inline]] inline Pixels Responses(const uint8_t* center, const Circle& offsets) {
  Pixels circle[kCircle];
  for (int i = 0; i < kCircle; ++i) circle[i] = Load(center + offsets[i]);
  constexpr int kHalf = kCircle / 2;
  Pixels least2[kHalf], most2[kHalf], least4[kHalf], most4[kHalf];  // so many, from 2 k + 1 on
  for (int k = 0; k < kHalf; ++k) {
    const Pixels &a = circle[2 * k + 1], &b = circle[(2 * k + 2) % kCircle];
    least2[k] = Min(a, b);
    most2[k] = Max(a, b);
  }
  for (int k = 0; k < kHalf; ++k) {
    least4[k] = Min(least2[k], least2[(k + 1) % kHalf]);
    most4[k] = Max(most2[k], most2[(k + 1) % kHalf]);
  }
  Pixels brightest{}, darkest = ~brightest;
  for (int k = 0; k < kHalf; ++k) {
    const Pixels &first = circle[2 * k], &last = circle[(2 * k + 9) % kCircle];
    const Pixels least8 = Min(least4[k], least4[(k + 2) % kHalf]);
    const Pixels most8 = Max(most4[k], most4[(k + 2) % kHalf]);
    brightest = Max(brightest, Min(least8, Max(first, last)));
    darkest = Min(darkest, Max(most8, Min(first, last)));
  }
  const Pixels here = Load(center);
  return Max(Max(brightest, here) - here, here - Min(darkest, here));
}

// Responses of the pixels from `begin` to `end`, and of some beside them, but of none whose circle
// would leave the row of `width` pixels.
MSC_VO_AVX2_IF_PRESENT
void ComputeResponses(const uint8_t* row, int width, const Circle& offsets, int begin, int end,
                      uint8_t* responses) {
  for (int x = begin; x < end; x += kLanes) {
    const int from = std::min(x, width - kFastRadius - kLanes);
    Store(Responses(row + from, offsets), responses + from);
  }
}

[[gnu::always_inline]] inline Pixels MostOfThree(const uint8_t* row) {
  return Max(Load(row), Max(Load(row - 1), Load(row + 1)));
}

// Strict maxima above `threshold` among responses, zero elsewhere.
[[gnu::always_inline]] inline Pixels Maxima(const uint8_t* above, const uint8_t* here,
                                            const uint8_t* below, const Pixels& threshold) {
  const Pixels sides = Max(Load(here - 1), Load(here + 1));
  const Pixels around = Max(Max(MostOfThree(above), MostOfThree(below)), Max(sides, threshold));
  const Pixels response = Load(here);
  return response > around ? response : Pixels{};
}

// Appends the corners of row `y` from column `begin` to `end`, given the responses of three rows.
MSC_VO_AVX2_IF_PRESENT
void CollectMaxima(const uint8_t* above, const uint8_t* here, const uint8_t* below, int width,
                   int y, int begin, int end, int threshold, std::vector<FastCorner>* corners) {
  const Pixels least = Pixels{} + static_cast<uint8_t>(threshold);
  for (int x = begin; x < end; x += kLanes) {
    const int from = std::min(x, width - 1 - kLanes);
    const Pixels maxima = Maxima(above + from, here + from, below + from, least);
    // Corners are rare: eight pixels at a time most can be passed over.
    std::array<uint64_t, kLanes / kWord> words;
    std::memcpy(words.data(), &maxima, sizeof(maxima));
    for (int first = 0; first < kLanes; first += kWord) {
      if (words[first / kWord] == 0) continue;
      for (int i = first; i < first + kWord; ++i) {
        const bool is_new = from + i >= x && from + i < end;
        if (maxima[i] > 0 && is_new) corners->push_back({{from + i, y}, maxima[i]});
      }
    }
  }
}

// The corners of an image, its rows taken in turn.
class CornerScan {
 public:
  CornerScan(const cv::Mat& image, const cv::Rect& area, int threshold)
      : image_(image),
        area_(area),
        threshold_(threshold),
        circle_(CircleOffsets(static_cast<std::ptrdiff_t>(image.step))) {
    for (std::vector<uint8_t>& row : responses_) row.resize(image.cols);
  }

  std::vector<FastCorner> Run() {
    const int left = area_.x, right = area_.x + area_.width;
    for (int y = area_.y - 1; y <= area_.y + area_.height; ++y) {
      ComputeResponses(image_.ptr<uint8_t>(y), image_.cols, circle_, left - 1, right + 1,
                       ResponsesOf(y));
      if (y <= area_.y) continue;
      CollectMaxima(ResponsesOf(y - 2), ResponsesOf(y - 1), ResponsesOf(y), image_.cols, y - 1,
                    left, right, threshold_, &corners_);
    }
    return std::move(corners_);
  }

 private:
  uint8_t* ResponsesOf(int y) { return responses_[y % responses_.size()].data(); }

  const cv::Mat& image_;
  cv::Rect area_;
  int threshold_;
  Circle circle_;
  std::array<std::vector<uint8_t>, 3> responses_;  // of three rows, by column of the image
  std::vector<FastCorner> corners_;
};

}  // namespace

std::vector<FastCorner> DetectFastCorners(const cv::Mat& image, const cv::Rect& area,
                                          int threshold) {
  const int margin = kFastRadius + 1;
  const cv::Rect inner(margin, margin, image.cols - 2 * margin, image.rows - 2 * margin);
  static_assert(kFastMinColumns == kLanes + 2 * (kFastRadius + 1));
  if (image.type() != CV_8UC1 || image.cols < kFastMinColumns || (area & inner) != area) {
    throw std::invalid_argument("DetectFastCorners: no 8-bit image of at least " +
                                std::to_string(kFastMinColumns) + " columns with the area inside");
  }
  return CornerScan(image, area, threshold).Run();
}

}  // namespace msc_vo
