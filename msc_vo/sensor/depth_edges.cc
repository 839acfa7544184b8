// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/sensor/depth_edges.h"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "msc_vo/sensor/standalone_image.h"

namespace msc_vo {

namespace {

// Least jump of inverse depth at an edge, 1/metres; the noise of a Kinect is 0.002.
constexpr float kMinJump = 0.06f;
// Gradients beyond this multiple of the mean count alike: one bright edge must not outweigh all.
constexpr double kGradientLimit = 6.0;

// Edges along a line of `count` pixels: visit(pixel, far_side).
template <typename At, typename Visit>
void ScanLine(int count, int max_gap, const At& inverse_depth_at, const Visit& visit) {
  int last = -1;
  float last_value = 0.0f;
  for (int i = 0; i < count; ++i) {
    const float value = inverse_depth_at(i);
    if (value <= 0.0f) continue;
    if (last >= 0 && i - last <= max_gap && std::abs(value - last_value) > kMinJump) {
      if (value > last_value) {
        visit(i, -1);
      } else {
        visit(last, 1);
      }
    }
    last = i;
    last_value = value;
  }
}

cv::Mat Normalize(const cv::Mat& derivative) {
  cv::Mat magnitude = cv::abs(derivative);
  const double limit = kGradientLimit * std::max(1.0, cv::mean(magnitude)[0]);
  cv::min(magnitude, limit, magnitude);
  cv::Scalar mean, deviation;
  cv::meanStdDev(magnitude, mean, deviation);
  cv::Mat normalized;
  magnitude.convertTo(normalized, CV_32F, 1.0 / std::max(1e-3, deviation[0]),
                      -mean[0] / std::max(1e-3, deviation[0]));
  return normalized;
}

}  // namespace

std::vector<DepthEdge> FindDepthEdges(const cv::Mat& depth, int max_gap) {
  cv::Mat inverse(depth.size(), CV_32FC1, cv::Scalar(0));
  for (int y = 0; y < depth.rows; ++y) {
    for (int x = 0; x < depth.cols; ++x) {
      const float z = depth.at<float>(y, x);
      if (z > 0.0f) inverse.at<float>(y, x) = 1.0f / z;
    }
  }
  std::vector<DepthEdge> edges;
  for (int y = 0; y < depth.rows; ++y) {
    ScanLine(
        depth.cols, max_gap, [&](int x) { return inverse.at<float>(y, x); },
        [&](int x, int far_side) {
          edges.push_back({x, y, true, far_side});
        });
  }
  for (int x = 0; x < depth.cols; ++x) {
    ScanLine(
        depth.rows, max_gap, [&](int y) { return inverse.at<float>(y, x); },
        [&](int y, int far_side) {
          edges.push_back({x, y, false, far_side});
        });
  }
  return edges;
}

EdgeGradients GradientsOf(const cv::Mat& gray) {
  cv::Mat smooth, dx, dy;
  cv::GaussianBlur(StandaloneImage(gray), smooth, cv::Size(3, 3), 0.8);
  cv::Sobel(smooth, dx, CV_32F, 1, 0);
  cv::Sobel(smooth, dy, CV_32F, 0, 1);
  return {Normalize(dx), Normalize(dy)};
}

double SumAtEdges(const std::vector<DepthEdge>& edges, const EdgeGradients& gradients, int dx,
                  int dy) {
  const int width = gradients.along_rows.cols, height = gradients.along_rows.rows;
  double sum = 0.0;
  for (const DepthEdge& edge : edges) {
    const int x = edge.x + dx, y = edge.y + dy;
    if (x < kEdgeBorder || x >= width - kEdgeBorder) continue;
    if (y < kEdgeBorder || y >= height - kEdgeBorder) continue;
    sum += (edge.horizontal_jump ? gradients.along_rows : gradients.along_columns).at<float>(y, x);
  }
  return sum;
}

ReducedImage Reduce(const cv::Mat& gray, const cv::Mat& depth, int width) {
  ReducedImage reduced{gray, depth};
  reduced.step = std::max(1.0, static_cast<double>(gray.cols) / width);
  if (reduced.step > 1.0) {
    const cv::Size size(width, static_cast<int>(std::lround(gray.rows / reduced.step)));
    cv::resize(gray, reduced.gray, size, 0.0, 0.0, cv::INTER_AREA);
    cv::resize(depth, reduced.depth, size, 0.0, 0.0, cv::INTER_NEAREST);
  }
  return reduced;
}

EdgeAgreement MeasureEdgeAgreement(const cv::Mat& gray, const cv::Mat& depth) {
  const ReducedImage reduced = Reduce(gray, depth);
  const std::vector<DepthEdge> edges = FindDepthEdges(reduced.depth);
  EdgeAgreement agreement;
  agreement.num_edges = static_cast<int>(edges.size());
  if (edges.empty()) return agreement;
  agreement.mean = SumAtEdges(edges, GradientsOf(reduced.gray), 0, 0) / agreement.num_edges;
  return agreement;
}

void EdgeComparison::Add(const cv::Mat& gray, const cv::Mat& before, const cv::Mat& after) {
  const EdgeAgreement old_agreement = MeasureEdgeAgreement(gray, before);
  const EdgeAgreement new_agreement = MeasureEdgeAgreement(gray, after);
  // Edges may leave the image, but not most of them.
  const bool is_better = new_agreement.mean > old_agreement.mean &&
                         2 * new_agreement.num_edges >= old_agreement.num_edges;
  (is_better ? num_better_ : num_worse_) += old_agreement.num_edges + new_agreement.num_edges;
}

}  // namespace msc_vo
