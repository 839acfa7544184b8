// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/results/thumbnail.h"

#include <algorithm>
#include <utility>

#include <opencv2/imgproc.hpp>

#include "msc_vo/image_files/jpeg_image.h"

namespace msc_vo {

namespace {

// The integer factor that reduces `size` to at most `max_size`: averaging is fast where both sides
// of an image are multiples of it.
int FactorTo(int max_size, int size) { return std::max(1, (size + max_size - 1) / max_size); }

cv::Mat ReducedBy(int factor, const cv::Mat& gray) {
  if (factor == 1) return gray;
  const cv::Size reduced(std::max(1, gray.cols / factor), std::max(1, gray.rows / factor));
  cv::Mat small;
  cv::resize(gray, small, reduced, 0.0, 0.0, cv::INTER_AREA);
  return small;
}

}  // namespace

std::string EncodeThumbnail(const cv::Mat& gray) {
  constexpr int kMaxWidth = 320;
  constexpr int kQuality = 60;  // percent
  return EncodeJpeg(ReducedBy(FactorTo(kMaxWidth, gray.cols), gray), kQuality);
}

std::string EncodeMapImage(const RgbdImage& image) {
  constexpr int kMaxSize = 160;
  constexpr size_t kMaxBytes = 2000;
  constexpr int kBestQuality = 60, kWorstQuality = 10;  // percent
  cv::Mat gray = image.gray;
  if (!image.mask.empty()) {
    gray = gray.clone();
    gray.setTo(0, image.mask);
  }
  cv::Mat small = ReducedBy(FactorTo(kMaxSize, std::max(gray.cols, gray.rows)), gray);
  std::string jpeg = EncodeJpeg(small, kWorstQuality);
  while (jpeg.size() > kMaxBytes) {  // noise
    small = ReducedBy(2, small);
    jpeg = EncodeJpeg(small, kWorstQuality);
  }
  // The best quality that fits.
  int best = kWorstQuality, too_good = kBestQuality + 1;
  while (too_good - best > 1) {
    const int quality = (best + too_good) / 2;
    std::string candidate = EncodeJpeg(small, quality);
    if (candidate.size() <= kMaxBytes) {
      best = quality;
      jpeg = std::move(candidate);
    } else {
      too_good = quality;
    }
  }
  return jpeg;
}

}  // namespace msc_vo
