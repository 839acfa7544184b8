// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/diagnosis/edge_alignment.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "msc_vo/diagnosis/quantile.h"

namespace msc_vo {

namespace {

// Width to which images are reduced: an edge is found to a fraction of a step anyway.
constexpr int kWidth = 320;
constexpr int kReach = 20;  // steps: 40 pixels of 640
// Largest gap without depth, steps, that an edge may span: the shadow of a structured-light sensor.
constexpr int kMaxGap = 10;
// Least jump of inverse depth at an edge, 1/metres; the noise of a Kinect is 0.002.
constexpr float kMinJump = 0.06f;
// Gradients beyond this multiple of the mean count alike: one bright edge must not outweigh all.
constexpr double kGradientLimit = 6.0;
constexpr int kBorder = 4;

struct EdgePixel {
  int x;
  int y;
  bool horizontal_jump;  // the depth jumps along the row
};

// Edges along a line of `count` pixels. The edge is at the nearer surface: the farther one ends
// where it is occluded, or where the sensor's shadow begins.
template <typename At, typename Visit>
void ScanLine(int count, const At& inverse_depth_at, const Visit& visit) {
  int last = -1;
  float last_value = 0.0f;
  for (int i = 0; i < count; ++i) {
    const float value = inverse_depth_at(i);
    if (value <= 0.0f) continue;
    if (last >= 0 && i - last <= kMaxGap && std::abs(value - last_value) > kMinJump) {
      visit(value > last_value ? i : last);
    }
    last = i;
    last_value = value;
  }
}

std::vector<EdgePixel> DepthEdges(const cv::Mat& depth) {
  cv::Mat inverse(depth.size(), CV_32FC1, cv::Scalar(0));
  for (int y = 0; y < depth.rows; ++y) {
    for (int x = 0; x < depth.cols; ++x) {
      const float z = depth.at<float>(y, x);
      if (z > 0.0f) inverse.at<float>(y, x) = 1.0f / z;
    }
  }
  std::vector<EdgePixel> edges;
  for (int y = 0; y < depth.rows; ++y) {
    ScanLine(
        depth.cols, [&](int x) { return inverse.at<float>(y, x); },
        [&](int x) {
          edges.push_back({x, y, true});
        });
  }
  for (int x = 0; x < depth.cols; ++x) {
    ScanLine(
        depth.rows, [&](int y) { return inverse.at<float>(y, x); },
        [&](int y) {
          edges.push_back({x, y, false});
        });
  }
  return edges;
}

// Gradients along rows and along columns with mean 0 and standard deviation 1.
struct Gradients {
  cv::Mat along_rows;
  cv::Mat along_columns;
};

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

Gradients GradientsOf(const cv::Mat& gray) {
  cv::Mat smooth, dx, dy;
  cv::GaussianBlur(gray, smooth, cv::Size(3, 3), 0.8);
  cv::Sobel(smooth, dx, CV_32F, 1, 0);
  cv::Sobel(smooth, dy, CV_32F, 0, 1);
  return {Normalize(dx), Normalize(dy)};
}

// Sum of the gradients at all edges, shifted by (dx, dy); edges that leave the image count 0.
double Score(const std::vector<EdgePixel>& edges, const Gradients& gradients, int dx, int dy) {
  const int width = gradients.along_rows.cols, height = gradients.along_rows.rows;
  double sum = 0.0;
  for (const EdgePixel& edge : edges) {
    const int x = edge.x + dx, y = edge.y + dy;
    if (x < kBorder || y < kBorder || x >= width - kBorder || y >= height - kBorder) continue;
    sum += (edge.horizontal_jump ? gradients.along_rows : gradients.along_columns).at<float>(y, x);
  }
  return sum;
}

cv::Mat Mirror(const cv::Mat& image, Mirroring mirroring) {
  if (mirroring == Mirroring::kNone) return image;
  cv::Mat mirrored;
  cv::flip(image, mirrored,
           mirroring == Mirroring::kHorizontal ? 1
           : mirroring == Mirroring::kVertical ? 0
                                               : -1);
  return mirrored;
}

double BestNearZero(const std::vector<EdgePixel>& edges, const Gradients& gradients) {
  double best = -1e9;
  for (int dy = -2; dy <= 2; ++dy) {
    for (int dx = -2; dx <= 2; ++dx) best = std::max(best, Score(edges, gradients, dx, dy));
  }
  return best;
}

// Offset of the vertex of the parabola through three equally spaced values, in steps.
double Vertex(double before, double at, double after) {
  const double curvature = before - 2.0 * at + after;
  return curvature < 0.0 ? std::clamp(0.5 * (before - after) / curvature, -0.5, 0.5) : 0.0;
}

}  // namespace

EdgeAlignment AlignEdges(const cv::Mat& gray, const cv::Mat& depth, bool tests_mirroring) {
  EdgeAlignment alignment;
  alignment.reach = kReach;
  alignment.step = std::max(1.0, static_cast<double>(gray.cols) / kWidth);
  cv::Mat small_gray = gray, small_depth = depth;
  if (alignment.step > 1.0) {
    const cv::Size size(kWidth, static_cast<int>(std::lround(gray.rows / alignment.step)));
    cv::resize(gray, small_gray, size, 0.0, 0.0, cv::INTER_AREA);
    cv::resize(depth, small_depth, size, 0.0, 0.0, cv::INTER_NEAREST);
  }
  const std::vector<EdgePixel> edges = DepthEdges(small_depth);
  alignment.num_edges = static_cast<int>(edges.size());
  const Gradients gradients = GradientsOf(small_gray);
  alignment.score.create(2 * kReach + 1, 2 * kReach + 1, CV_32FC1);
  for (int dy = -kReach; dy <= kReach; ++dy) {
    for (int dx = -kReach; dx <= kReach; ++dx) {
      alignment.score.at<float>(dy + kReach, dx + kReach) =
          static_cast<float>(Score(edges, gradients, dx, dy));
    }
  }
  if (!tests_mirroring || edges.empty()) return alignment;
  for (int m = 0; m < kNumMirrorings; ++m) {
    const cv::Mat mirrored = Mirror(small_gray, static_cast<Mirroring>(m));
    alignment.mirrored_score[m] = BestNearZero(edges, GradientsOf(mirrored));
  }
  return alignment;
}

void Add(const EdgeAlignment& image, EdgeAlignment* sum) {
  if (sum->score.empty()) {
    *sum = image;
    sum->score = image.score.clone();
  } else {
    sum->score += image.score;
    sum->num_edges += image.num_edges;
    for (int m = 0; m < kNumMirrorings; ++m) {
      sum->mirrored_score[m] += image.mirrored_score[m];
    }
  }
}

EdgeShift FindPeak(const EdgeAlignment& alignment) {
  EdgeShift result;
  if (alignment.num_edges == 0) return result;
  const cv::Mat& score = alignment.score;
  cv::Point peak;
  cv::minMaxLoc(score, nullptr, nullptr, nullptr, &peak);
  const auto at = [&](int x, int y) {
    return score.at<float>(std::clamp(y, 0, score.rows - 1), std::clamp(x, 0, score.cols - 1)) /
           static_cast<double>(alignment.num_edges);
  };
  result.peak = at(peak.x, peak.y);
  result.at_zero = at(alignment.reach, alignment.reach);
  std::vector<double> values;
  for (int y = 0; y < score.rows; ++y) {
    for (int x = 0; x < score.cols; ++x) values.push_back(at(x, y));
  }
  result.background = Median(std::move(values));
  const double x = peak.x - alignment.reach +
                   Vertex(at(peak.x - 1, peak.y), result.peak, at(peak.x + 1, peak.y));
  const double y = peak.y - alignment.reach +
                   Vertex(at(peak.x, peak.y - 1), result.peak, at(peak.x, peak.y + 1));
  result.shift = alignment.step * Eigen::Vector2d(x, y);
  return result;
}

}  // namespace msc_vo
