// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/features/internal/edge_segments.h"

#include <cmath>

namespace msc_vo {

namespace {

using Eigen::Vector2d;

// A gradient agrees with a line if it is within 22.5 degrees of the line's normal. The probability
// for a random gradient is 1/8.
constexpr double kChanceOfAgreement = 0.125;
const double kMaxSineSquared = 0.5 - std::sqrt(0.125);  // sin^2(22.5 degrees)
// Largest distance of a pixel from its line, pixels: half a pixel of rounding and half a pixel of
// noise.
constexpr double kMaxDistance = 1.0;
// Largest variance of a line's pixels across it, square pixels: 1/12 from rounding, the rest from
// noise of half a pixel.
constexpr double kMaxVariance = 0.25;
// A line ends after this number of consecutive pixels that are farther away.
constexpr int kMaxMisses = 4;
// The line is refitted whenever the number of its pixels has grown by this factor.
constexpr double kRefitGrowth = 1.25;

// Kullback-Leibler divergence between Bernoulli distributions with probabilities p and q, nats.
double Divergence(double p, double q) {
  const auto term = [](double a, double b) { return a > 0.0 ? a * std::log(a / b) : 0.0; };
  return term(p, q) + term(1.0 - p, 1.0 - q);
}

}  // namespace

// Moments of pixels, accumulated relative to an origin among them for numerical accuracy.
class EdgeSegmentDetector::PixelMoments {
 public:
  explicit PixelMoments(const Vector2d& origin) : origin_(origin) {}

  void Add(const Vector2d& pixel) { Accumulate(pixel, 1.0); }
  void Remove(const Vector2d& pixel) { Accumulate(pixel, -1.0); }

  double count() const { return count_; }
  Vector2d Mean() const { return origin_ + sum_ / count_; }
  // Second central moments xx, xy, yy.
  Eigen::Vector3d Covariance() const {
    const Vector2d mean = sum_ / count_;
    return squares_ / count_ -
           Eigen::Vector3d(mean.x() * mean.x(), mean.x() * mean.y(), mean.y() * mean.y());
  }

 private:
  void Accumulate(const Vector2d& pixel, double sign) {
    const Vector2d d = pixel - origin_;
    count_ += sign;
    sum_ += sign * d;
    squares_ += sign * Eigen::Vector3d(d.x() * d.x(), d.x() * d.y(), d.y() * d.y());
  }

  Vector2d origin_;
  double count_ = 0.0;
  Vector2d sum_ = Vector2d::Zero();
  Eigen::Vector3d squares_ = Eigen::Vector3d::Zero();
};

// Total least-squares line through pixels.
struct EdgeSegmentDetector::FittedLine {
  Vector2d point;
  Vector2d direction;
  double variance = 0.0;  // across the line, square pixels

  explicit FittedLine(const PixelMoments& moments) : point(moments.Mean()) {
    const Eigen::Vector3d c = moments.Covariance();
    const double half_difference = 0.5 * (c[0] - c[2]);
    const double radius = std::sqrt(half_difference * half_difference + c[1] * c[1]);
    variance = 0.5 * (c[0] + c[2]) - radius;
    // The eigenvector has two forms; this is the one without cancellation.
    direction = half_difference >= 0.0 ? Vector2d(half_difference + radius, c[1])
                                       : Vector2d(c[1], radius - half_difference);
    direction.normalize();
  }

  double Distance(const Vector2d& x) const {
    const Vector2d d = x - point;
    return std::abs(direction.x() * d.y() - direction.y() * d.x());
  }
  Vector2d Foot(const Vector2d& x) const { return point + direction.dot(x - point) * direction; }
};

const std::vector<LineSegment2>& EdgeSegmentDetector::Detect(const cv::Mat& gray) {
  // Number of tests: a segment has two end points, each any pixel of the image.
  min_information_ = 2.0 * std::log(static_cast<double>(gray.total()));
  min_pixels_ = static_cast<int>(std::ceil(min_information_ / -std::log(kChanceOfAgreement)));
  segments_.clear();
  gradient_.Compute(gray);
  drawing_.Draw(gradient_);
  for (const EdgeDrawing::Chain& chain : drawing_.chains()) FitChain(chain);
  return segments_;
}

Vector2d EdgeSegmentDetector::PixelAt(int index) const {
  const int pixel = drawing_.pixels()[index];
  return {pixel % gradient_.width(), pixel / gradient_.width()};
}

void EdgeSegmentDetector::FitChain(const EdgeDrawing::Chain& chain) {
  int begin = chain.begin;
  while (begin + min_pixels_ <= chain.end) {
    // Find the first min_pixels_ consecutive pixels that lie on a line.
    PixelMoments moments(PixelAt(begin));
    int end = begin;
    while (end < begin + min_pixels_) moments.Add(PixelAt(end++));
    FittedLine line(moments);
    while (line.variance > kMaxVariance && end < chain.end) {
      moments.Remove(PixelAt(begin++));
      moments.Add(PixelAt(end++));
      line = FittedLine(moments);
    }
    if (line.variance > kMaxVariance) return;
    end = Extend(chain.end, end, moments, &line);
    if (IsMeaningful(begin, end, line.direction)) {
      segments_.push_back({line.Foot(PixelAt(begin)), line.Foot(PixelAt(end - 1))});
    }
    begin = end;
  }
}

// Extends a piece with the given end and moments as long as the chain follows its line, and fits
// the line to it. Returns the new end.
int EdgeSegmentDetector::Extend(int chain_end, int end, PixelMoments moments,
                                FittedLine* line) const {
  double refit_count = kRefitGrowth * moments.count();
  int reached = end;
  const auto refit = [&] {
    const FittedLine longer(moments);
    if (longer.variance > kMaxVariance) return false;
    *line = longer;
    end = reached;
    refit_count = kRefitGrowth * moments.count();
    return true;
  };
  for (int next = end; next < chain_end && next - reached <= kMaxMisses; ++next) {
    const Vector2d pixel = PixelAt(next);
    if (line->Distance(pixel) > kMaxDistance) continue;
    moments.Add(pixel);
    reached = next + 1;
    // Detects slow bends, where each pixel is close to the line fitted last.
    if (moments.count() >= refit_count && !refit()) return end;
  }
  refit();
  return end;
}

// By the Chernoff bound, the probability that k of n independent gradients agree by chance is at
// most exp(-n D(k/n || 1/8)) if k/n > 1/8.
bool EdgeSegmentDetector::IsMeaningful(int begin, int end, const Vector2d& direction) const {
  int num_agreeing = 0;
  for (int i = begin; i < end; ++i) {
    const int pixel = drawing_.pixels()[i];
    const Vector2d g(gradient_.X(pixel), gradient_.Y(pixel));
    const double along = g.dot(direction);
    num_agreeing += along * along <= kMaxSineSquared * g.squaredNorm();
  }
  const double ratio = num_agreeing / static_cast<double>(end - begin);
  return ratio > kChanceOfAgreement &&
         (end - begin) * Divergence(ratio, kChanceOfAgreement) >= min_information_;
}

}  // namespace msc_vo
