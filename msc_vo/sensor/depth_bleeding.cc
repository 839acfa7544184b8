// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/sensor/depth_bleeding.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <opencv2/imgproc.hpp>

#include "msc_vo/sensor/standalone_image.h"

namespace msc_vo {

namespace {

// Half the widest matching window is this part of the width of the image (10 of 640 px).
constexpr int kMaxReachDivisor = 64;
// Reach until it is measured, as a part of the width of the image: 4 of 640 px.
constexpr int kTypicalReachDivisor = 160;
// A depth edge is a relative change of inverse depth by this much between neighbouring pixels.
constexpr double kEdgeChange = 0.06;
// Smallest mean gradient around an edge that counts, grey levels: below, there is only noise.
constexpr double kMinGradient = 2.0;
// Pixels on depth edges: the minimum needed to estimate the reach, and a sufficient number.
constexpr int kMinEdges = 60;
constexpr int kEnoughEdges = 500;
// The mean gradient on both sides of an edge is the same up to this ratio.
constexpr double kSameGradient = 0.98;
// The farthest depth of a window has the lowest noise of its side: with a Gaussian correlation of
// the noise over the window, its mean is -0.53 standard deviations on surfaces that are not
// parallel to the image, whatever their inclination (simulated).
constexpr double kLowestNoise = 0.53;
constexpr int kRowStep = 2;

cv::Mat InverseOf(const cv::Mat& depth) {
  cv::Mat inverse(depth.size(), CV_32FC1);
  for (int y = 0; y < depth.rows; ++y) {
    const float* z = depth.ptr<float>(y);
    float* w = inverse.ptr<float>(y);
    for (int x = 0; x < depth.cols; ++x) w[x] = z[x] > 0.0f ? 1.0f / z[x] : 0.0f;
  }
  return inverse;
}

// Absolute central differences along the rows.
cv::Mat RowGradient(const cv::Mat& gray) {
  cv::Mat gradient = cv::Mat::zeros(gray.size(), CV_32FC1);
  for (int y = 0; y < gray.rows; ++y) {
    const float* g = gray.ptr<float>(y);
    float* out = gradient.ptr<float>(y);
    for (int x = 1; x + 1 < gray.cols; ++x) out[x] = std::abs(g[x + 1] - g[x - 1]);
  }
  return gradient;
}

}  // namespace

BleedingEstimator::BleedingEstimator(int width)
    : max_reach_(std::max(2, width / kMaxReachDivisor)), gradient_(2 * max_reach_ + 1, 0.0) {}

void BleedingEstimator::AddRows(const cv::Mat& gradient, const cv::Mat& inverse_depth) {
  for (int y = 0; y < inverse_depth.rows; y += kRowStep) {
    const float* w = inverse_depth.ptr<float>(y);
    const float* g = gradient.ptr<float>(y);
    for (int x = max_reach_; x + max_reach_ + 1 < inverse_depth.cols; ++x) {
      const float left = w[x], right = w[x + 1];
      if (left <= 0.0f || right <= 0.0f) continue;
      if (std::abs(right - left) < kEdgeChange * std::max(left, right)) continue;
      // The nearer pixel of the two has distance 0.
      const int origin = right > left ? x + 1 : x;
      const int towards_near = right > left ? 1 : -1;
      double sum = 0.0;
      for (int i = -max_reach_; i <= max_reach_; ++i) sum += g[origin + i];
      if (sum < kMinGradient * static_cast<double>(gradient_.size())) continue;
      for (int i = -max_reach_; i <= max_reach_; ++i) {
        gradient_[max_reach_ + i] += g[origin + towards_near * i] / sum;
      }
      ++num_edges_;
    }
  }
}

void BleedingEstimator::Add(const cv::Mat& gray, const cv::Mat& depth) {
  cv::Mat smooth;
  gray.convertTo(smooth, CV_32F);
  cv::GaussianBlur(smooth, smooth, cv::Size(), 0.8);
  const cv::Mat inverse = InverseOf(depth);
  AddRows(RowGradient(smooth), inverse);
  AddRows(RowGradient(smooth.t()), inverse.t());
}

bool BleedingEstimator::IsDone() const { return num_edges_ >= kEnoughEdges; }

int BleedingEstimator::reach() const {
  if (num_edges_ < kMinEdges) return (max_reach_ * kMaxReachDivisor) / kTypicalReachDivisor;
  // Without bleeding, the gradients of the pixels 0 and -1, on both sides of the edge, are largest.
  int best = 0;
  for (int i = 1; i <= max_reach_; ++i) {
    if (gradient_[max_reach_ + i] > kSameGradient * gradient_[max_reach_ + best]) best = i;
  }
  return best;
}

cv::Mat RemoveBleeding(const cv::Mat& depth, int reach, double sigma) {
  if (reach <= 0) return depth;
  const cv::Mat kernel = cv::getStructuringElement(cv::MORPH_RECT, {2 * reach + 1, 2 * reach + 1});
  cv::Mat restored;
  cv::dilate(StandaloneImage(depth), restored, kernel);
  const auto bias = static_cast<float>(kLowestNoise * sigma);
  for (int y = 0; y < depth.rows; ++y) {
    const float* z = depth.ptr<float>(y);
    float* out = restored.ptr<float>(y);
    for (int x = 0; x < depth.cols; ++x)
      out[x] = z[x] > 0.0f ? out[x] / (1.0f + bias * out[x]) : 0.0f;
  }
  return restored;
}

}  // namespace msc_vo
