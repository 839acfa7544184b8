// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/features/fast_corners.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>

#include <opencv2/core/hal/intrin.hpp>

namespace msc_vo {

namespace {

// Sixteen pixels at once, on every processor.
using Pixels = cv::v_uint8x16;
constexpr int kLanes = Pixels::nlanes;
constexpr int kCircle = 16;

// Where the pixels of the circle are from its centre, clockwise from above.
using Circle = std::array<std::ptrdiff_t, kCircle>;
Circle CircleOffsets(std::ptrdiff_t step) {
  return {-3 * step, -3 * step + 1, -2 * step + 2, -step + 3,
          3,         step + 3,      2 * step + 2,  3 * step + 1,
          3 * step,  3 * step - 1,  2 * step - 2,  step - 3,
          -3,        -step - 3,     -2 * step - 2, -3 * step - 1};
}

// Responses of sixteen pixels. Two arcs of nine that begin side by side, at an even place and the
// one behind it, have the eight pixels between their ends in common: what all of those exceed and
// one of the two ends.
Pixels Responses(const uint8_t* center, const Circle& offsets) {
  std::array<Pixels, kCircle> circle;
  for (int i = 0; i < kCircle; ++i) circle[i] = cv::v_load(center + offsets[i]);
  constexpr int kHalf = kCircle / 2;
  std::array<Pixels, kHalf> least2, most2, least4, most4;  // of that many, from 2 k + 1 on
  for (int k = 0; k < kHalf; ++k) {
    const Pixels &a = circle[2 * k + 1], &b = circle[(2 * k + 2) % kCircle];
    least2[k] = cv::v_min(a, b);
    most2[k] = cv::v_max(a, b);
  }
  for (int k = 0; k < kHalf; ++k) {
    least4[k] = cv::v_min(least2[k], least2[(k + 1) % kHalf]);
    most4[k] = cv::v_max(most2[k], most2[(k + 1) % kHalf]);
  }
  Pixels brightest = cv::v_setzero_u8(), darkest = cv::v_setall_u8(255);
  for (int k = 0; k < kHalf; ++k) {
    const Pixels &first = circle[2 * k], &last = circle[(2 * k + 9) % kCircle];
    const Pixels least8 = cv::v_min(least4[k], least4[(k + 2) % kHalf]);
    const Pixels most8 = cv::v_max(most4[k], most4[(k + 2) % kHalf]);
    brightest = cv::v_max(brightest, cv::v_min(least8, cv::v_max(first, last)));
    darkest = cv::v_min(darkest, cv::v_max(most8, cv::v_min(first, last)));
  }
  const Pixels here = cv::v_load(center);
  return cv::v_max(brightest - here, here - darkest);  // differences end at zero
}

// Sixteen of the strict maxima above `threshold` among responses, zero elsewhere.
Pixels Maxima(const uint8_t* above, const uint8_t* here, const uint8_t* below,
              const Pixels& threshold) {
  const auto most_of_three = [](const uint8_t* row) {
    return cv::v_max(cv::v_load(row), cv::v_max(cv::v_load(row - 1), cv::v_load(row + 1)));
  };
  const Pixels sides = cv::v_max(cv::v_load(here - 1), cv::v_load(here + 1));
  const Pixels around =
      cv::v_max(cv::v_max(most_of_three(above), most_of_three(below)), cv::v_max(sides, threshold));
  const Pixels response = cv::v_load(here);
  return response & (response > around);
}

// The corners of an image, its rows taken in turn.
class CornerScan {
 public:
  CornerScan(const cv::Mat& image, const cv::Rect& area, int threshold)
      : image_(image),
        area_(area),
        threshold_(cv::v_setall_u8(static_cast<uint8_t>(threshold))),
        circle_(CircleOffsets(static_cast<std::ptrdiff_t>(image.step))) {
    for (std::vector<uint8_t>& row : responses_) row.resize(image.cols);
  }

  std::vector<FastCorner> Run() {
    for (int y = area_.y - 1; y <= area_.y + area_.height; ++y) {
      ComputeRow(y);
      if (y > area_.y) CollectRow(y - 1);
    }
    return std::move(corners_);
  }

 private:
  uint8_t* ResponsesOf(int y) { return responses_[y % responses_.size()].data(); }

  void ComputeRow(int y) {
    const uint8_t* row = image_.ptr<uint8_t>(y);
    uint8_t* responses = ResponsesOf(y);
    for (int x = area_.x - 1; x <= area_.x + area_.width; x += kLanes) {
      const int from = std::min(x, image_.cols - kFastRadius - kLanes);
      cv::v_store(responses + from, Responses(row + from, circle_));
    }
  }

  // Of a row whose neighbours are computed.
  void CollectRow(int y) {
    const int end = area_.x + area_.width;
    for (int x = area_.x; x < end; x += kLanes) {
      const int from = std::min(x, image_.cols - 1 - kLanes);
      const Pixels maxima = Maxima(ResponsesOf(y - 1) + from, ResponsesOf(y) + from,
                                   ResponsesOf(y + 1) + from, threshold_);
      if (!cv::v_check_any(maxima > cv::v_setzero_u8())) continue;
      std::array<uint8_t, kLanes> lanes;
      cv::v_store(lanes.data(), maxima);
      for (int i = x; i < std::min(x + kLanes, end); ++i) {
        if (lanes[i - from] > 0) corners_.push_back({{i, y}, lanes[i - from]});
      }
    }
  }

  const cv::Mat& image_;
  cv::Rect area_;
  Pixels threshold_;
  Circle circle_;
  std::array<std::vector<uint8_t>, 3> responses_;  // of three rows, by column of the image
  std::vector<FastCorner> corners_;
};

}  // namespace

std::vector<FastCorner> DetectFastCorners(const cv::Mat& image, const cv::Rect& area,
                                          int threshold) {
  const int margin = kFastRadius + 1;
  const cv::Rect inner(margin, margin, image.cols - 2 * margin, image.rows - 2 * margin);
  if (image.type() != CV_8UC1 || image.cols < kLanes + 2 * margin || (area & inner) != area) {
    throw std::invalid_argument("DetectFastCorners: no 8-bit image of at least " +
                                std::to_string(kLanes + 2 * margin) +
                                " columns with the area inside");
  }
  return CornerScan(image, area, threshold).Run();
}

}  // namespace msc_vo
