// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/geometry/line_fit.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace msc_vo {

namespace {

// Inverse depth at both end points of the segment, (w_start, w_end).
using Line = Eigen::Vector2d;

// Largest residual of an inlier, in sigmas of the sample: 99 % quantile of a normal deviate.
constexpr double kInlierSigmas = 2.576;
// RANSAC iterations: 40 pairs contain a clean one with 99 % probability at 1/3 inliers.
constexpr int kMaxIterations = 40;
// Smallest fraction of inliers among the samples. With fewer, the segment lies on a depth edge,
// where neither side has the majority.
constexpr double kMinInlierRatio = 0.5;
// Smallest number of inliers: two samples determine a line, and the others must agree with it.
constexpr int kMinInliers = 5;
// The inlier set of a least-squares line converges in two or three rounds; this limit ends cycles.
constexpr int kMaxRefits = 10;
// Smallest distance of two samples on the segment that determine a line.
constexpr double kMinSampleGap = 1e-6;
// Probability of having drawn a pair without outliers.
constexpr double kConfidence = 0.99;
constexpr int kMaxPairs = 1000000;

double NormalizedResidual(const Line& line, const LineFitSample& sample) {
  const double predicted = (1.0 - sample.s) * line[0] + sample.s * line[1];
  return (sample.inverse_depth - predicted) / sample.sigma;
}

struct Score {
  // Sum of squared residuals (in sigmas), each truncated at the inlier threshold. Unlike the number
  // of inliers, it distinguishes an accurate line from one whose samples are just below it.
  double truncated_cost = 0.0;
  int num_inliers = 0;
};

Score ScoreOf(const Line& line, const std::vector<LineFitSample>& samples) {
  Score score;
  for (const LineFitSample& sample : samples) {
    const double r = NormalizedResidual(line, sample);
    const bool inlier = std::abs(r) <= kInlierSigmas;
    score.truncated_cost += inlier ? r * r : kInlierSigmas * kInlierSigmas;
    score.num_inliers += inlier;
  }
  return score;
}

// Number of pairs that contain one without outliers with probability kConfidence.
int PairsNeeded(int num_inliers, size_t num_samples) {
  const double ratio = static_cast<double>(num_inliers) / static_cast<double>(num_samples);
  if (ratio >= 1.0) return 1;
  const double pairs = std::log(1.0 - kConfidence) / std::log(1.0 - ratio * ratio);
  return pairs < kMaxPairs ? static_cast<int>(std::ceil(pairs)) : kMaxPairs;
}

std::optional<Line> LineThrough(const LineFitSample& a, const LineFitSample& b) {
  if (std::abs(b.s - a.s) < kMinSampleGap) return std::nullopt;
  const double slope = (b.inverse_depth - a.inverse_depth) / (b.s - a.s);
  return Line(a.inverse_depth - slope * a.s, a.inverse_depth + slope * (1.0 - a.s));
}

struct LeastSquares {
  Line line = Line::Zero();
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
  int num_inliers = 0;
};

// Weighted least-squares fit to the inliers of `line`.
std::optional<LeastSquares> Refit(const Line& line, const std::vector<LineFitSample>& samples) {
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
  Eigen::Vector2d rhs = Eigen::Vector2d::Zero();
  double s_min = 1e9;
  double s_max = -1e9;
  LeastSquares fit;
  for (const LineFitSample& sample : samples) {
    if (std::abs(NormalizedResidual(line, sample)) > kInlierSigmas) continue;
    const Eigen::Vector2d a = Eigen::Vector2d(1.0 - sample.s, sample.s) / sample.sigma;
    information += a * a.transpose();
    rhs += a * (sample.inverse_depth / sample.sigma);
    s_min = std::min(s_min, sample.s);
    s_max = std::max(s_max, sample.s);
    ++fit.num_inliers;
  }
  if (fit.num_inliers < 2 || s_max - s_min < kMinSampleGap) return std::nullopt;
  fit.covariance = information.inverse();
  fit.line = fit.covariance * rhs;
  return fit;
}

// RANSAC for the best line through two samples; every new best line is refined by one least-squares
// fit to its inliers.
class LineRansac {
 public:
  explicit LineRansac(const std::vector<LineFitSample>& samples) : samples_(samples) {}

  std::optional<Line> Run(uint32_t seed) {
    const size_t n = samples_.size();
    if (n * (n - 1) / 2 <= static_cast<size_t>(kMaxIterations)) {
      for (size_t i = 0; i < n; ++i) {
        for (size_t j = i + 1; j < n; ++j) Try(i, j);
      }
      return best_;
    }
    std::minstd_rand random(seed % 2147483646u + 1u);  // the state must not be 0
    for (int iteration = 0; iteration < std::min(kMaxIterations, pairs_needed_); ++iteration) {
      const size_t i = random() % n;
      const size_t j = (i + 1 + random() % (n - 1)) % n;
      Try(i, j);
    }
    return best_;
  }

 private:
  void Try(size_t i, size_t j) {
    const std::optional<Line> line = LineThrough(samples_[i], samples_[j]);
    if (!line || !UpdateBest(*line)) return;
    const auto fit = Refit(*line, samples_);
    if (fit) UpdateBest(fit->line);
  }

  // Returns true if `line` is better than the best one so far.
  bool UpdateBest(const Line& line) {
    const Score score = ScoreOf(line, samples_);
    if (best_ && score.truncated_cost >= best_cost_) return false;
    best_ = line;
    best_cost_ = score.truncated_cost;
    pairs_needed_ = PairsNeeded(score.num_inliers, samples_.size());
    return true;
  }

  const std::vector<LineFitSample>& samples_;
  std::optional<Line> best_;
  double best_cost_ = 0.0;
  int pairs_needed_ = kMaxPairs;
};

}  // namespace

double LineDepth::SigmaAt(double s) const {
  const Eigen::Vector2d a(1.0 - s, s);
  return std::sqrt(a.dot(covariance * a));
}

LineDepth Nearer(const LineDepth& depth, double offset) {
  LineDepth nearer = depth;
  nearer.start = depth.start / (1.0 - depth.start * offset);
  nearer.end = depth.end / (1.0 - depth.end * offset);
  return nearer;
}

LineSegment3 BackProject(const PinholeCamera& camera, const LineSegment2& segment,
                         const LineDepth& depth) {
  return {camera.BackProject(segment.start, 1.0 / depth.start),
          camera.BackProject(segment.end, 1.0 / depth.end)};
}

double DirectionSigma(const PinholeCamera& camera, const LineSegment2& segment,
                      const LineDepth& depth) {
  // The difference of the end points, scaled by w_s w_e, is D = w_s r_e - w_e r_s, parallel to the
  // 3-D segment. Its derivatives are r_e and -r_s; their components across D rotate it.
  const Eigen::Vector3d ray_start = camera.Ray(segment.start);
  const Eigen::Vector3d ray_end = camera.Ray(segment.end);
  const Eigen::Vector3d d = depth.start * ray_end - depth.end * ray_start;
  const Eigen::Vector3d direction = d.normalized();
  const Eigen::Vector3d across_start = ray_end - direction * direction.dot(ray_end);
  const Eigen::Vector3d across_end = ray_start - direction * direction.dot(ray_start);
  // Both components lie in the interpretation plane across D, thus along the same axis.
  const Eigen::Vector3d axis = direction.cross(ray_start.cross(ray_end).normalized());
  const Eigen::Vector2d jacobian(across_start.dot(axis), -across_end.dot(axis));
  return std::sqrt(jacobian.dot(depth.covariance * jacobian)) / d.norm();
}

std::optional<LineDepth> FitLineDepth(const std::vector<LineFitSample>& samples, uint32_t seed) {
  if (samples.size() < static_cast<size_t>(kMinInliers)) return std::nullopt;

  std::optional<Line> line = LineRansac(samples).Run(seed);
  std::optional<LeastSquares> fit;
  for (int round = 0; round < kMaxRefits && line; ++round) {
    fit = Refit(*line, samples);
    if (!fit || fit->line == *line) break;
    line = fit->line;
  }
  if (!fit || fit->num_inliers < kMinInliers) return std::nullopt;

  LineDepth depth;
  depth.start = fit->line[0];
  depth.end = fit->line[1];
  depth.covariance = fit->covariance;
  depth.num_inliers = fit->num_inliers;
  depth.inlier_ratio = static_cast<double>(fit->num_inliers) / samples.size();
  const bool in_front = depth.start > 0.0 && depth.end > 0.0;
  if (!in_front || depth.inlier_ratio < kMinInlierRatio) return std::nullopt;
  return depth;
}

}  // namespace msc_vo
