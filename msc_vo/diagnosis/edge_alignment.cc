// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/diagnosis/edge_alignment.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "msc_vo/geometry/quantile.h"
#include "msc_vo/sensor/depth_edges.h"

namespace msc_vo {

namespace {

constexpr int kCoarseWidth = 320, kFineWidth = 640;  // pixels
// Reaches in steps. The coarse one is 40 pixels of 640: unregistered cameras of Kinects are off by
// 10 to 30.
constexpr int kCoarseReach = 20;
// Steps on both sides of a peak that determine its place: saturated gradients make the top of a
// peak flat over three steps.
constexpr int kPeakReach = 2;
// The fine peak is searched for within this distance of the coarse one, coarse steps.
constexpr double kSearchRadius = 1.5;
// Shifts up to 5 pixels of 640, the largest usual ones, are refined: 5 + 2 * kSearchRadius +
// kPeakReach.
constexpr int kFineReach = 10;
// Mirrored images are otherwise registered, to 4 pixels of 640.
constexpr int kMirroredReach = 2;
// Largest widening of near surfaces, coarse steps, and the ratio of the peaks with one and without
// that warrants it: without edges on opposite sides, it is not distinguished from a shift. Measured
// in docs/lab/depth.md.
constexpr int kMaxWidening = 4;
constexpr double kMinWideningGain = 1.02;
// Uncertainty of the widening, coarse steps.
constexpr int kWideningError = 2;
// Size of the cells that distinguish repeated edges from others, pixels of the coarse image: more
// than the noise of an edge's place.
constexpr int kCellSize = 4;

cv::Mat Mirror(const cv::Mat& image, Mirroring mirroring) {
  cv::Mat mirrored;
  cv::flip(image, mirrored,
           mirroring == Mirroring::kHorizontal ? 1
           : mirroring == Mirroring::kVertical ? 0
                                               : -1);
  return mirrored;
}

// Directions to the farther surface, in the order of EdgeScore::by_side; the first two are jumps
// along rows.
constexpr std::array<std::array<int, 2>, kNumFarSides> kFarSides = {
    {{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};

// Depth edges with each far side as weights of the pixels, CV_32FC1: an edge is between pixels.
using EdgeWeights = std::array<cv::Mat, kNumFarSides>;

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
  EdgeWeights weights;
  for (cv::Mat& side : weights) side = cv::Mat::zeros(reduced, CV_32FC1);
  for (const DepthEdge& edge : edges) {
    const int side = (edge.horizontal_jump ? 0 : 2) + (edge.far_side > 0 ? 0 : 1);
    AddEdge(SampleCenter(edge.x, reduced.width, full.width) + 0.5 * kFarSides[side][0],
            SampleCenter(edge.y, reduced.height, full.height) + 0.5 * kFarSides[side][1],
            &weights[side]);
  }
  return weights;
}

// Adds the correlation of weights and gradients for all shifts within the reach of `sum`.
void AddCorrelation(const cv::Mat& weights, const cv::Mat& gradients, cv::Mat* sum) {
  const int size = sum->cols, reach = size / 2;
  if (weights.rows <= 2 * kEdgeBorder || weights.cols <= 2 * kEdgeBorder) return;
  cv::Mat padded(weights.rows + 2 * reach, weights.cols + 2 * reach, CV_32FC1, cv::Scalar(0));
  const cv::Rect inside(kEdgeBorder, kEdgeBorder, weights.cols - 2 * kEdgeBorder,
                        weights.rows - 2 * kEdgeBorder);
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

EdgeScore Correlate(const EdgeWeights& weights, const EdgeGradients& gradients, int reach) {
  EdgeScore score;
  score.reach = reach;
  for (int side = 0; side < kNumFarSides; ++side) {
    cv::Mat sum = cv::Mat::zeros(2 * reach + 1, 2 * reach + 1, CV_32FC1);
    AddCorrelation(weights[side], side < 2 ? gradients.along_rows : gradients.along_columns, &sum);
    sum.convertTo(score.by_side[side], CV_64F);
  }
  return score;
}

// A reduced image with its edges.
struct ReducedEdges {
  ReducedImage image;
  std::vector<DepthEdge> edges;
  EdgeWeights weights;
};

ReducedEdges FindReducedEdges(const cv::Mat& gray, const cv::Mat& depth, int width) {
  const ReducedImage image = Reduce(gray, depth, width);
  // The same gap at all widths, so that coarse and fine edges are those of the same surfaces.
  const double coarse_step = std::max(1.0, static_cast<double>(depth.cols) / kCoarseWidth);
  const auto max_gap = static_cast<int>(std::ceil(kMaxEdgeGap * coarse_step / image.step));
  std::vector<DepthEdge> edges = FindDepthEdges(image.depth, max_gap);
  EdgeWeights weights = WeightsOf(edges, image.depth.size(), depth.size());
  return {image, std::move(edges), std::move(weights)};
}

EdgeScore ScoreOf(const ReducedEdges& reduced, const EdgeGradients& gradients, int reach) {
  EdgeScore score = Correlate(reduced.weights, gradients, reach);
  score.step = reduced.image.step;
  score.num_edges = static_cast<int>(reduced.edges.size());
  return score;
}

// The part of a score for shifts up to `reach`.
EdgeScore CentralPart(const EdgeScore& score, int reach) {
  const int first = score.reach - reach, size = 2 * reach + 1;
  EdgeScore part{score.step, reach, {}, score.num_edges};
  for (int side = 0; side < kNumFarSides; ++side) {
    part.by_side[side] = score.by_side[side](cv::Rect(first, first, size, size)).clone();
  }
  return part;
}

// Edges along rows and along columns in each cell.
cv::Mat CountInCells(const std::vector<DepthEdge>& edges, const cv::Size& size) {
  cv::Mat cells((size.height + kCellSize - 1) / kCellSize, (size.width + kCellSize - 1) / kCellSize,
                CV_8UC2, cv::Scalar::all(0));
  for (const DepthEdge& edge : edges) {
    auto& counts = cells.at<cv::Vec2b>(edge.y / kCellSize, edge.x / kCellSize);
    ++counts[edge.horizontal_jump ? 0 : 1];
  }
  return cells;
}

double Maximum(const cv::Mat& score) {
  double maximum = 0.0;
  cv::minMaxLoc(score, nullptr, &maximum);
  return maximum;
}

// The gradients of a mirrored image are the mirrored gradients.
double MirroredScore(const EdgeWeights& weights, const EdgeGradients& gradients,
                     Mirroring mirroring) {
  const EdgeGradients mirrored{Mirror(gradients.along_rows, mirroring),
                               Mirror(gradients.along_columns, mirroring)};
  return Maximum(Correlate(weights, mirrored, kMirroredReach).Sum());
}

void AddScore(const EdgeScore& score, EdgeScore* total) {
  if (total->by_side[0].empty()) {
    *total = score;
    for (cv::Mat& side : total->by_side) side = side.clone();
    return;
  }
  for (int side = 0; side < kNumFarSides; ++side) total->by_side[side] += score.by_side[side];
  total->num_edges += score.num_edges;
}

// Offset in steps of the vertex of the parabola that fits best to the values at -2, -1, 0, 1 and 2.
double Vertex(const std::array<double, 2 * kPeakReach + 1>& values) {
  double slope = 0.0, curvature = 0.0;
  for (int i = 0; i < 2 * kPeakReach + 1; ++i) {
    const int x = i - kPeakReach;
    slope += x * values[i] / 10.0;
    curvature += (x * x - 2) * values[i] / 7.0;
  }
  return curvature < 0.0 ? std::clamp<double>(-slope / curvature, -kPeakReach, kPeakReach) : 0.0;
}

// Place of the peak beside element `start` of a line of `count` values, to a fraction of an
// element: the vertex of a parabola around the element nearest to that vertex, so that the centre
// of a flat top is found from each of its elements. `start` at the end of the line.
template <typename At>
double PeakBeside(int start, int count, const At& value_at) {
  int center = start;
  double offset = 0.0;
  for (int i = 0; i <= kPeakReach; ++i) {
    if (center < kPeakReach || center >= count - kPeakReach) return start;
    std::array<double, 2 * kPeakReach + 1> values;
    for (int k = 0; k < 2 * kPeakReach + 1; ++k) values[k] = value_at(center + k - kPeakReach);
    offset = Vertex(values);
    const int move = static_cast<int>(std::lround(offset));
    if (move == 0) break;
    center += move;
    offset -= move;
  }
  return center + offset;
}

// Shift of an element of a sum over all edges to a fraction of a step, pixels of the full image.
Eigen::Vector2d ShiftOf(const cv::Mat& sum, double step, const cv::Point& element) {
  const auto in_row = [&](int x) { return sum.at<double>(element.y, x); };
  const auto in_column = [&](int y) { return sum.at<double>(y, element.x); };
  const int reach = sum.cols / 2;
  return step * Eigen::Vector2d(PeakBeside(element.x, sum.cols, in_row) - reach,
                                PeakBeside(element.y, sum.rows, in_column) - reach);
}

// Shift of the fine score's peak beside the coarse one, whose shift is given; none if the fine
// score has no peak there.
std::optional<Eigen::Vector2d> FindFinePeak(const EdgeAlignment& alignment,
                                            const Eigen::Vector2d& coarse) {
  const EdgeScore& fine = alignment.fine;
  const double ratio = alignment.coarse.step / fine.step;
  if (2.0 * fine.num_edges < ratio * alignment.coarse.num_edges) return std::nullopt;
  const Eigen::Array2d center = coarse.array() / fine.step + fine.reach;
  const auto first = (center - kSearchRadius * ratio).ceil().cast<int>().eval();
  const auto last = (center + kSearchRadius * ratio).floor().cast<int>().eval();
  if (first.minCoeff() < kPeakReach || last.maxCoeff() > 2 * fine.reach - kPeakReach) {
    return std::nullopt;
  }
  const cv::Rect region(first.x(), first.y(), last.x() - first.x() + 1, last.y() - first.y() + 1);
  const cv::Mat sum = fine.Sum();
  cv::Point peak;
  cv::minMaxLoc(sum(region), nullptr, nullptr, nullptr, &peak);
  if (peak.x == 0 || peak.y == 0 || peak.x == region.width - 1 || peak.y == region.height - 1) {
    return std::nullopt;
  }
  return ShiftOf(sum, fine.step, peak + region.tl());
}

}  // namespace

cv::Mat EdgeScore::Sum(int widening) const {
  cv::Mat sum = cv::Mat::zeros(2 * reach + 1, 2 * reach + 1, CV_64FC1);
  for (int side = 0; side < kNumFarSides; ++side) {
    const Eigen::Vector2d far_side(kFarSides[side][0], kFarSides[side][1]);
    sum += widening == 0 ? by_side[side] : MovedScore(by_side[side], -widening * far_side);
  }
  return sum;
}

EdgeAlignment AlignEdges(const cv::Mat& gray, const cv::Mat& depth, bool with_fine) {
  const ReducedEdges coarse = FindReducedEdges(gray, depth, kCoarseWidth);
  const EdgeGradients gradients = GradientsOf(coarse.image.gray);
  EdgeAlignment alignment;
  alignment.coarse = ScoreOf(coarse, gradients, kCoarseReach);
  if (depth.cols <= kCoarseWidth) {
    alignment.fine = CentralPart(alignment.coarse, kFineReach);
  } else if (with_fine) {
    const ReducedEdges fine = FindReducedEdges(gray, depth, kFineWidth);
    alignment.fine = ScoreOf(fine, GradientsOf(fine.image.gray), kFineReach);
  }
  alignment.cells = CountInCells(coarse.edges, coarse.image.depth.size());
  alignment.mirrored_score[0] = Maximum(CentralPart(alignment.coarse, kMirroredReach).Sum());
  for (int m = 1; m < kNumMirrorings; ++m) {
    alignment.mirrored_score[m] =
        MirroredScore(coarse.weights, gradients, static_cast<Mirroring>(m));
  }
  return alignment;
}

cv::Mat MovedScore(const cv::Mat& score, const Eigen::Vector2d& steps) {
  const auto nearest = [&score](double i) {
    return static_cast<int>(std::clamp(i, 0.0, score.cols - 1.0));
  };
  const double left = std::floor(steps.x()), top = std::floor(steps.y());
  const double a = steps.x() - left, b = steps.y() - top;
  cv::Mat moved(score.size(), CV_64FC1);
  for (int y = 0; y < score.rows; ++y) {
    const auto* above = score.ptr<double>(nearest(y + top));
    const auto* below = score.ptr<double>(nearest(y + top + 1.0));
    for (int x = 0; x < score.cols; ++x) {
      const int i = nearest(x + left), j = nearest(x + left + 1.0);
      moved.at<double>(y, x) = (1.0 - b) * ((1.0 - a) * above[i] + a * above[j]) +
                               b * ((1.0 - a) * below[i] + a * below[j]);
    }
  }
  return moved;
}

void Add(const EdgeAlignment& image, EdgeAlignment* sum) {
  AddScore(image.coarse, &sum->coarse);
  AddScore(image.fine, &sum->fine);
  if (sum->cells.empty()) {
    sum->cells = image.cells.clone();
  } else {
    cv::max(sum->cells, image.cells, sum->cells);
  }
  for (int m = 0; m < kNumMirrorings; ++m) sum->mirrored_score[m] += image.mirrored_score[m];
}

int NumDistinctEdges(const EdgeAlignment& alignment) {
  const cv::Scalar sum = cv::sum(alignment.cells);
  return static_cast<int>(sum[0] + sum[1]);
}

EdgeShift FindPeak(const EdgeAlignment& alignment) {
  EdgeShift result;
  const EdgeScore& coarse = alignment.coarse;
  if (coarse.num_edges == 0) return result;
  std::array<cv::Mat, kMaxWidening + 1> sums;
  int widening = 0;
  for (int w = 0; w <= kMaxWidening; ++w) {
    sums[w] = coarse.Sum(w);
    const double gain = widening == 0 ? kMinWideningGain : 1.0;
    if (Maximum(sums[w]) > gain * Maximum(sums[widening])) widening = w;
  }
  const cv::Mat& sum = sums[widening];
  for (int w = 0; w <= kMaxWidening; ++w) {
    if (std::abs(w - widening) > kWideningError) continue;
    const double at_zero = sums[w].at<double>(coarse.reach, coarse.reach) / coarse.num_edges;
    result.at_zero = std::max(result.at_zero, at_zero);
  }
  cv::Point peak;
  cv::minMaxLoc(sum, nullptr, &result.peak, nullptr, &peak);
  result.peak /= coarse.num_edges;
  result.background =
      Median(std::vector<double>(sum.begin<double>(), sum.end<double>())) / coarse.num_edges;
  result.widening = widening * coarse.step;
  result.shift = ShiftOf(sum, coarse.step, peak);
  if (widening == 0) result.shift = FindFinePeak(alignment, result.shift).value_or(result.shift);
  return result;
}

}  // namespace msc_vo
