// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/diagnosis/edge_alignment.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "msc_vo/diagnosis/quantile.h"
#include "msc_vo/sensor/depth_edges.h"

namespace msc_vo {

namespace {

constexpr int kCoarseWidth = 320, kFineWidth = 640;  // pixels
constexpr int kCoarseReach = 20;                     // steps: 40 pixels of 640
constexpr int kFineReach = 10;
constexpr int kMirroredReach = 2;
// Gradients so close to the border do not count, pixels.
constexpr int kBorder = 4;

cv::Mat Mirror(const cv::Mat& image, Mirroring mirroring) {
  if (mirroring == Mirroring::kNone) return image;
  cv::Mat mirrored;
  cv::flip(image, mirrored,
           mirroring == Mirroring::kHorizontal ? 1
           : mirroring == Mirroring::kVertical ? 0
                                               : -1);
  return mirrored;
}

// Depth edges as weights of the pixels, CV_32FC1: an edge is between pixels.
struct EdgeWeights {
  cv::Mat along_rows;
  cv::Mat along_columns;
};

// Centre of the pixel of the full image that pixel i of the reduced depth image comes from, in
// pixels of the reduced image.
double SampleCenter(int i, int reduced_size, int full_size) {
  const double scale = static_cast<double>(full_size) / reduced_size;
  return (std::floor(i * scale) + 0.5) / scale - 0.5;
}

// Distributes an edge among the four pixels around it.
void AddEdge(double x, double y, cv::Mat* weights) {
  const int left = static_cast<int>(std::floor(x)), top = static_cast<int>(std::floor(y));
  const auto a = static_cast<float>(x - left), b = static_cast<float>(y - top);
  const auto add = [weights](int column, int row, float weight) {
    if (column < 0 || row < 0 || column >= weights->cols || row >= weights->rows) return;
    weights->at<float>(row, column) += weight;
  };
  add(left, top, (1.0f - a) * (1.0f - b));
  add(left + 1, top, a * (1.0f - b));
  add(left, top + 1, (1.0f - a) * b);
  add(left + 1, top + 1, a * b);
}

// Weights of the edges of a reduced depth image. `full`: size of the image before.
EdgeWeights WeightsOf(const std::vector<DepthEdge>& edges, cv::Size reduced, cv::Size full) {
  EdgeWeights weights{cv::Mat::zeros(reduced, CV_32FC1), cv::Mat::zeros(reduced, CV_32FC1)};
  for (const DepthEdge& edge : edges) {
    const double x = SampleCenter(edge.x, reduced.width, full.width);
    const double y = SampleCenter(edge.y, reduced.height, full.height);
    const double to_edge = 0.5 * edge.far_side;
    if (edge.horizontal_jump) {
      AddEdge(x + to_edge, y, &weights.along_rows);
    } else {
      AddEdge(x, y + to_edge, &weights.along_columns);
    }
  }
  return weights;
}

// Adds the correlation of weights and gradients for all shifts within the reach of `sum`.
void AddCorrelation(const cv::Mat& weights, const cv::Mat& gradients, cv::Mat* sum) {
  const int size = sum->cols, reach = size / 2;
  if (weights.rows <= 2 * kBorder || weights.cols <= 2 * kBorder) return;
  cv::Mat padded(weights.rows + 2 * reach, weights.cols + 2 * reach, CV_32FC1, cv::Scalar(0));
  const cv::Rect inside(kBorder, kBorder, weights.cols - 2 * kBorder, weights.rows - 2 * kBorder);
  gradients(inside).copyTo(padded(inside + cv::Point(reach, reach)));
  for (int y = 0; y < weights.rows; ++y) {
    for (int x = 0; x < weights.cols; ++x) {
      const float weight = weights.at<float>(y, x);
      if (weight == 0.0f) continue;
      for (int row = 0; row < size; ++row) {
        const float* gradient = padded.ptr<float>(y + row) + x;
        auto* total = sum->ptr<float>(row);
        for (int column = 0; column < size; ++column) total[column] += weight * gradient[column];
      }
    }
  }
}

cv::Mat Correlate(const EdgeWeights& weights, const EdgeGradients& gradients, int reach) {
  cv::Mat sum = cv::Mat::zeros(2 * reach + 1, 2 * reach + 1, CV_32FC1), score;
  AddCorrelation(weights.along_rows, gradients.along_rows, &sum);
  AddCorrelation(weights.along_columns, gradients.along_columns, &sum);
  sum.convertTo(score, CV_64F);
  return score;
}

// A reduced image with its edges.
struct ReducedEdges {
  ReducedImage image;
  int num_edges = 0;
  EdgeWeights weights;
};

ReducedEdges FindReducedEdges(const cv::Mat& gray, const cv::Mat& depth, int width) {
  const ReducedImage image = Reduce(gray, depth, width);
  const std::vector<DepthEdge> edges = FindDepthEdges(image.depth);
  return {image, static_cast<int>(edges.size()),
          WeightsOf(edges, image.depth.size(), depth.size())};
}

EdgeScore ScoreOf(const ReducedEdges& reduced, int reach) {
  return {reduced.image.step, reach,
          Correlate(reduced.weights, GradientsOf(reduced.image.gray), reach), reduced.num_edges};
}

double MirroredScore(const ReducedEdges& reduced, Mirroring mirroring) {
  const cv::Mat scores = Correlate(
      reduced.weights, GradientsOf(Mirror(reduced.image.gray, mirroring)), kMirroredReach);
  double best = 0.0;
  cv::minMaxLoc(scores, nullptr, &best);
  return best;
}

void AddScore(const EdgeScore& score, EdgeScore* total) {
  if (total->sum.empty()) {
    *total = score;
    total->sum = score.sum.clone();
  } else {
    total->sum += score.sum;
    total->num_edges += score.num_edges;
  }
}

// Offset of the vertex of the parabola through three equally spaced values, in steps.
double Vertex(double before, double at, double after) {
  const double curvature = before - 2.0 * at + after;
  return curvature < 0.0 ? std::clamp(0.5 * (before - after) / curvature, -0.5, 0.5) : 0.0;
}

// Shift of an element of a score to a fraction of a step, pixels of the full image.
Eigen::Vector2d ShiftOf(const EdgeScore& score, const cv::Point& element) {
  const auto at = [&](int x, int y) {
    return score.sum.at<double>(std::clamp(y, 0, score.sum.rows - 1),
                                std::clamp(x, 0, score.sum.cols - 1));
  };
  const int x = element.x, y = element.y;
  return score.step *
         Eigen::Vector2d(x - score.reach + Vertex(at(x - 1, y), at(x, y), at(x + 1, y)),
                         y - score.reach + Vertex(at(x, y - 1), at(x, y), at(x, y + 1)));
}

// Peak of the fine score within a step and a half of the coarse one, whose shift is given; none if
// the fine score does not reach as far.
std::optional<Eigen::Vector2d> FindFinePeak(const EdgeAlignment& alignment,
                                            const Eigen::Vector2d& coarse) {
  const EdgeScore& fine = alignment.fine;
  const Eigen::Array2d center = coarse.array() / fine.step + fine.reach;
  const double radius = 1.5 * alignment.coarse.step / fine.step;
  const auto first = (center - radius).ceil().cast<int>().eval();
  const auto last = (center + radius).floor().cast<int>().eval();
  if (first.minCoeff() < 1 || last.maxCoeff() >= 2 * fine.reach) return std::nullopt;
  const cv::Rect region(first.x(), first.y(), last.x() - first.x() + 1, last.y() - first.y() + 1);
  cv::Point peak;
  cv::minMaxLoc(fine.sum(region), nullptr, nullptr, nullptr, &peak);
  return ShiftOf(fine, peak + region.tl());
}

}  // namespace

EdgeAlignment AlignEdges(const cv::Mat& gray, const cv::Mat& depth, bool tests_mirroring) {
  const ReducedEdges coarse = FindReducedEdges(gray, depth, kCoarseWidth);
  EdgeAlignment alignment;
  alignment.coarse = ScoreOf(coarse, kCoarseReach);
  alignment.fine = ScoreOf(FindReducedEdges(gray, depth, kFineWidth), kFineReach);
  if (!tests_mirroring || coarse.num_edges == 0) return alignment;
  for (int m = 0; m < kNumMirrorings; ++m) {
    alignment.mirrored_score[m] = MirroredScore(coarse, static_cast<Mirroring>(m));
  }
  return alignment;
}

void Add(const EdgeAlignment& image, EdgeAlignment* sum) {
  AddScore(image.coarse, &sum->coarse);
  AddScore(image.fine, &sum->fine);
  for (int m = 0; m < kNumMirrorings; ++m) sum->mirrored_score[m] += image.mirrored_score[m];
}

EdgeShift FindPeak(const EdgeAlignment& alignment) {
  EdgeShift result;
  const EdgeScore& coarse = alignment.coarse;
  if (coarse.num_edges == 0) return result;
  cv::Point peak;
  cv::minMaxLoc(coarse.sum, nullptr, &result.peak, nullptr, &peak);
  result.peak /= coarse.num_edges;
  result.at_zero = coarse.sum.at<double>(coarse.reach, coarse.reach) / coarse.num_edges;
  std::vector<double> values(coarse.sum.begin<double>(), coarse.sum.end<double>());
  result.background = Median(std::move(values)) / coarse.num_edges;
  result.shift = ShiftOf(coarse, peak);
  result.shift = FindFinePeak(alignment, result.shift).value_or(result.shift);
  return result;
}

}  // namespace msc_vo
