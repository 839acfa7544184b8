// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/features/internal/fast_corners.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <utility>

#include "msc_vo/features/internal/byte_vector.h"

namespace msc_vo {

namespace {

constexpr int kLanes = ByteVector::kLanes;
constexpr int kCircle = 16;

// Offsets of the pixels of the circle from its centre, clockwise from above.
using Circle = std::array<std::ptrdiff_t, kCircle>;
Circle CircleOffsets(std::ptrdiff_t step) {
  return {-3 * step, -3 * step + 1, -2 * step + 2, -step + 3,
          3,         step + 3,      2 * step + 2,  3 * step + 1,
          3 * step,  3 * step - 1,  2 * step - 2,  step - 3,
          -3,        -step - 3,     -2 * step - 2, -3 * step - 1};
}

// Responses of kLanes pixels from `center` on.
//
// The response of a pixel needs, over the 16 arcs of nine pixels, the largest of the minima and the
// smallest of the maxima. The arcs that begin at 2k and 2k + 1 have eight pixels in common, from
// 2k + 1 on: the better of the two arcs adds the better one of their two other pixels. The extrema
// of eight pixels are combined from those of two and of four.
MSC_VO_INLINE ByteVector Responses(const uint8_t* center, const Circle& offsets) {
  ByteVector circle[kCircle];
  for (int i = 0; i < kCircle; ++i) circle[i] = ByteVector::Load(center + offsets[i]);
  constexpr int kPairs = kCircle / 2;
  // Extrema of the two and of the four pixels from 2k + 1 on.
  ByteVector min2[kPairs], max2[kPairs], min4[kPairs], max4[kPairs];
  for (int k = 0; k < kPairs; ++k) {
    const ByteVector &a = circle[2 * k + 1], &b = circle[(2 * k + 2) % kCircle];
    min2[k] = Min(a, b);
    max2[k] = Max(a, b);
  }
  for (int k = 0; k < kPairs; ++k) {
    min4[k] = Min(min2[k], min2[(k + 1) % kPairs]);
    max4[k] = Max(max2[k], max2[(k + 1) % kPairs]);
  }
  ByteVector max_of_minima(uint8_t{0}), min_of_maxima(uint8_t{255});
  for (int k = 0; k < kPairs; ++k) {
    const ByteVector &first = circle[2 * k], &last = circle[(2 * k + 9) % kCircle];
    const ByteVector min8 = Min(min4[k], min4[(k + 2) % kPairs]);
    const ByteVector max8 = Max(max4[k], max4[(k + 2) % kPairs]);
    max_of_minima = Max(max_of_minima, Min(min8, Max(first, last)));
    min_of_maxima = Min(min_of_maxima, Max(max8, Min(first, last)));
  }
  const ByteVector value = ByteVector::Load(center);
  return Max(SubtractSaturated(max_of_minima, value), SubtractSaturated(value, min_of_maxima));
}

// Computes the responses of the pixels of a row from column `begin` to `end`, and of some beside
// them, but of none whose circle leaves the row of `width` pixels.
MSC_VO_AVX2_IF_PRESENT
void ComputeResponses(const uint8_t* row, int width, const Circle& offsets, int begin, int end,
                      uint8_t* responses) {
  for (int x = begin; x < end; x += kLanes) {
    const int from = std::min(x, width - kFastRadius - kLanes);
    Responses(row + from, offsets).Store(responses + from);
  }
}

// Maximum of each pixel and its two neighbours in the row.
MSC_VO_INLINE ByteVector MaxOfThree(const uint8_t* row) {
  return Max(ByteVector::Load(row), Max(ByteVector::Load(row - 1), ByteVector::Load(row + 1)));
}

// The strict maxima above `threshold` among the responses of row `here`, zero elsewhere.
MSC_VO_INLINE ByteVector Maxima(const uint8_t* above, const uint8_t* here, const uint8_t* below,
                                const ByteVector& threshold) {
  const ByteVector beside = Max(ByteVector::Load(here - 1), ByteVector::Load(here + 1));
  const ByteVector neighbours = Max(Max(MaxOfThree(above), MaxOfThree(below)), beside);
  return ZeroUnlessAbove(ByteVector::Load(here), Max(neighbours, threshold));
}

// Appends the corners of row `y` from column `begin` to `end`, given the responses of three rows.
MSC_VO_AVX2_IF_PRESENT
void CollectMaxima(const uint8_t* above, const uint8_t* here, const uint8_t* below, int width,
                   int y, int begin, int end, int threshold, std::vector<FastCorner>* corners) {
  constexpr int kWord = sizeof(uint64_t);
  const ByteVector thresholds(static_cast<uint8_t>(threshold));
  for (int x = begin; x < end; x += kLanes) {
    const int from = std::min(x, width - 1 - kLanes);
    std::array<uint8_t, kLanes> maxima;
    Maxima(above + from, here + from, below + from, thresholds).Store(maxima.data());
    for (int first = 0; first < kLanes; first += kWord) {
      // Corners are rare: most pixels are skipped eight at a time.
      uint64_t word;
      std::memcpy(&word, &maxima[first], kWord);
      if (word == 0) continue;
      for (int i = first; i < first + kWord; ++i) {
        const bool is_new = from + i >= x && from + i < end;
        if (maxima[i] > 0 && is_new) corners->push_back({{from + i, y}, maxima[i]});
      }
    }
  }
}

// Detects the corners of an image row by row, with the responses of the last three rows.
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
  std::array<std::vector<uint8_t>, 3> responses_;  // by column of the image
  std::vector<FastCorner> corners_;
};

}  // namespace

std::vector<FastCorner> DetectFastCorners(const cv::Mat& image, const cv::Rect& area,
                                          int threshold) {
  const int margin = kFastRadius + 1;
  const cv::Rect inner(margin, margin, image.cols - 2 * margin, image.rows - 2 * margin);
  static_assert(kFastMinColumns == kLanes + 2 * (kFastRadius + 1));
  if (image.type() != CV_8UC1 || image.cols < kFastMinColumns || (area & inner) != area) {
    throw std::invalid_argument(
        "DetectFastCorners: the image must be 8-bit grey (CV_8UC1), at least " +
        std::to_string(kFastMinColumns) + " pixels wide, and contain the area with a margin of " +
        std::to_string(margin) + " pixels");
  }
  return CornerScan(image, area, threshold).Run();
}

}  // namespace msc_vo
