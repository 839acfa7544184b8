// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/sensor/lens_remap.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <Eigen/LU>

namespace msc_vo {

namespace {

constexpr int kSteps = 32;  // of a pixel

// A coordinate in an image of `size` pixels as a pixel and the distance from it in steps;
// coordinates outside the image become its border.
std::pair<uint32_t, uint8_t> SplitCoordinate(double coordinate, int size) {
  const auto near = static_cast<float>(std::clamp(coordinate, -1.0, 1.0 * size));
  const int steps = std::clamp(cvRound(near * kSteps), 0, (size - 1) * kSteps);
  return {steps / kSteps, steps % kSteps};
}

// A pixel, and in the upper byte the one to its right: one load from memory.
uint16_t TwoPixels(const uint8_t* pixel) { return static_cast<uint16_t>(pixel[0] | pixel[1] << 8); }

// Interpolates a row. The sums of products are exact.
void Interpolate(const std::vector<uint16_t>& upper, const std::vector<uint16_t>& lower,
                 const uint8_t* right, const uint8_t* down, uint8_t* row) {
  const auto across = [](uint16_t pixels, int right) {
    return static_cast<uint16_t>((pixels & 0xff) * (kSteps - right) + (pixels >> 8) * right);
  };
  for (size_t x = 0; x < upper.size(); ++x) {
    const uint32_t sum =
        across(upper[x], right[x]) * (kSteps - down[x]) + across(lower[x], right[x]) * down[x];
    row[x] = static_cast<uint8_t>((sum + kSteps * kSteps / 2) / (kSteps * kSteps));
  }
}

}  // namespace

cv::Mat UndistortedPixels(const PinholeCamera& camera, const LensDistortion& distortion) {
  cv::Mat ideal(camera.height, camera.width, CV_32FC2);
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      const Eigen::Vector2d pixel = distortion.Undistort(camera, {x, y});
      ideal.at<cv::Vec2f>(y, x) = {static_cast<float>(pixel.x()), static_cast<float>(pixel.y())};
    }
  }
  return ideal;
}

double LargestStretch(const PinholeCamera& camera, const LensDistortion& lens) {
  constexpr int kIntervals = 32;
  double largest = 1.0;
  if (lens.model == LensModel::kRadialTangential && !lens.recorded) return 1.0;
  const double zoom = lens.Recorded(camera).FocalLength() / camera.FocalLength();
  for (int i = 0; i <= kIntervals * kIntervals + 2 * kIntervals; ++i) {
    const Eigen::Vector2d pixel(camera.width * (i % (kIntervals + 1)) / kIntervals,
                                camera.height * (i / (kIntervals + 1)) / kIntervals);
    largest = std::max(largest, zoom * lens.Jacobian(camera.Ray(pixel).head<2>()).norm());
  }
  return largest;
}

LensRemap::LensRemap(const PinholeCamera& camera, const LensDistortion& distortion)
    : camera_(camera), distortion_(distortion) {
  if (distortion.IsZero()) return;
  mask_ = cv::Mat::zeros(camera.height, camera.width, CV_8UC1);
  raw_pixels_.resize(mask_.total());
  right_.resize(mask_.total());
  down_.resize(mask_.total());
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      const Eigen::Vector2d raw = distortion.Distort(camera, {x, y});
      if (distortion.Recorded(camera).IsInside(raw)) mask_.at<uint8_t>(y, x) = 255;
      const auto [column, right] = SplitCoordinate(raw.x(), camera.width);
      const auto [row, down] = SplitCoordinate(raw.y(), camera.height);
      const size_t i = static_cast<size_t>(y) * camera.width + x;
      raw_pixels_[i] = row * (camera.width + 1) + column;
      right_[i] = right;
      down_[i] = down;
    }
  }
}

double LensRemap::Magnification(const Eigen::Vector2d& ideal_pixel) const {
  if (distortion_.IsZero()) return 1.0;
  const PinholeCamera& raw = distortion_.Recorded(camera_);
  const Eigen::Matrix2d jacobian = distortion_.Jacobian(camera_.Ray(ideal_pixel).head<2>());
  return std::abs(camera_.fx * camera_.fy / (raw.fx * raw.fy * jacobian.determinant()));
}

cv::Mat LensRemap::Undistort(const cv::Mat& raw) const {
  if (distortion_.IsZero()) return raw;
  if (raw.depth() != CV_8U || raw.size() != mask_.size()) {
    throw std::invalid_argument("LensRemap: the image must have 8 bits and the size of the camera");
  }
  if (raw.channels() > 1) {
    std::vector<cv::Mat> channels;
    cv::split(raw, channels);
    for (cv::Mat& channel : channels) channel = Undistort(channel);
    cv::Mat ideal;
    cv::merge(channels, ideal);
    return ideal;
  }
  cv::Mat bordered;
  cv::copyMakeBorder(raw, bordered, 0, 1, 0, 1, cv::BORDER_REPLICATE);
  cv::Mat ideal(raw.size(), CV_8UC1);
  std::vector<uint16_t> upper(raw.cols), lower(raw.cols);
  for (int y = 0; y < raw.rows; ++y) {
    const size_t first = static_cast<size_t>(y) * raw.cols;
    for (int x = 0; x < raw.cols; ++x) {
      const uint8_t* const pixel = bordered.data + raw_pixels_[first + x];
      upper[x] = TwoPixels(pixel);
      lower[x] = TwoPixels(pixel + bordered.cols);
    }
    Interpolate(upper, lower, &right_[first], &down_[first], ideal.ptr(y));
  }
  return ideal;
}

}  // namespace msc_vo
