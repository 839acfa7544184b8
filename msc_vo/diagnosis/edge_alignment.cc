// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/diagnosis/edge_alignment.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "msc_vo/diagnosis/quantile.h"
#include "msc_vo/sensor/depth_edges.h"

namespace msc_vo {

namespace {

constexpr int kReach = 20;  // steps: 40 pixels of 640

cv::Mat Mirror(const cv::Mat& image, Mirroring mirroring) {
  if (mirroring == Mirroring::kNone) return image;
  cv::Mat mirrored;
  cv::flip(image, mirrored,
           mirroring == Mirroring::kHorizontal ? 1
           : mirroring == Mirroring::kVertical ? 0
                                               : -1);
  return mirrored;
}

double BestNearZero(const std::vector<DepthEdge>& edges, const EdgeGradients& gradients) {
  double best = -1e9;
  for (int dy = -2; dy <= 2; ++dy) {
    for (int dx = -2; dx <= 2; ++dx) best = std::max(best, SumAtEdges(edges, gradients, dx, dy));
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
  const ReducedImage reduced = Reduce(gray, depth);
  alignment.step = reduced.step;
  const std::vector<DepthEdge> edges = FindDepthEdges(reduced.depth);
  alignment.num_edges = static_cast<int>(edges.size());
  const EdgeGradients gradients = GradientsOf(reduced.gray);
  alignment.score.create(2 * kReach + 1, 2 * kReach + 1, CV_32FC1);
  for (int dy = -kReach; dy <= kReach; ++dy) {
    for (int dx = -kReach; dx <= kReach; ++dx) {
      alignment.score.at<float>(dy + kReach, dx + kReach) =
          static_cast<float>(SumAtEdges(edges, gradients, dx, dy));
    }
  }
  if (!tests_mirroring || edges.empty()) return alignment;
  for (int m = 0; m < kNumMirrorings; ++m) {
    const cv::Mat mirrored = Mirror(reduced.gray, static_cast<Mirroring>(m));
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
