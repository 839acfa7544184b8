// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/self_calibration/noise_estimator.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include "msc_vo/geometry/quantile.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

// Bound of depth residuals in robust standard deviations, against single gross errors (an edge, a
// mirror).
constexpr double kMaxResidual = 3.0;
// Largest weight of the past, in image quadrants: the influence of older windows decays. The
// relative standard deviation of the estimated variance is sqrt(2 / 400) = 7 %.
// Chosen by measurement, see docs/lab/self_calibration.md.
constexpr double kMemory = 400.0;
// Median of the absolute value of a standard normal variable.
constexpr double kNormalMedian = 0.6745;

struct Residual {
  int64_t keyframe = 0;
  int quadrant = 0;    // of the image, 0..3
  double value = 0.0;  // in sigmas
  // Expected variance for independent errors, 1 - 1 / n: the estimated landmark absorbs one degree
  // of freedom of its n measurements.
  double expected = 0.0;
};
using Residuals = std::vector<Residual>;

// Collects the residuals of one kind of measurement.
class ResidualCollector {
 public:
  explicit ResidualCollector(const WindowResiduals& residuals)
      : residuals_(residuals), window_(residuals.window()) {}

  Residuals PointDepths() const {
    return Depths(window_.point_observations, window_.points.size(), &WindowResiduals::PointIndex,
                  &WindowResiduals::PointDepth);
  }
  Residuals LineDepths() const {
    return Depths(window_.line_observations, window_.lines.size(), &WindowResiduals::LineIndex,
                  &WindowResiduals::LineDepth);
  }

  // Residuals at both end points. Rejected observations are included, because otherwise a sigma
  // that is too small would reject the observations that contradict it. They did not contribute to
  // the landmark, so that their expected variance is 1.
  Residuals LinePixels() const {
    const auto& observations = window_.line_observations;
    std::vector<int> num_accepted(window_.lines.size(), 0);
    for (size_t i = 0; i < observations.size(); ++i) {
      num_accepted[residuals_.LineIndex(i)] += !observations[i].rejected;
    }
    Residuals all;
    all.reserve(2 * observations.size());
    for (size_t i = 0; i < observations.size(); ++i) {
      const WindowData::LineObservation& o = observations[i];
      const std::optional<Eigen::Vector2d> residual = residuals_.LinePixel(i);
      if (!residual) continue;
      const double expected = o.rejected ? 1.0 : 1.0 - 1.0 / num_accepted[residuals_.LineIndex(i)];
      for (const int end : {0, 1}) {
        all.push_back({o.keyframe, QuadrantOf(o), (*residual)[end], expected});
      }
    }
    return all;
  }

 private:
  template <typename Observation>
  Residuals Depths(const std::vector<Observation>& observations, size_t num_landmarks,
                   int (WindowResiduals::*landmark)(size_t) const,
                   std::optional<double> (WindowResiduals::*depth)(size_t) const) const {
    std::vector<int> num_depths(num_landmarks, 0);
    for (size_t i = 0; i < observations.size(); ++i) {
      num_depths[(residuals_.*landmark)(i)] +=
          !observations[i].rejected && (residuals_.*depth)(i).has_value();
    }
    Residuals all;
    all.reserve(observations.size());
    for (size_t i = 0; i < observations.size(); ++i) {
      const Observation& o = observations[i];
      const std::optional<double> residual = (residuals_.*depth)(i);
      if (o.rejected || !residual) continue;
      const int count = num_depths[(residuals_.*landmark)(i)];
      all.push_back({o.keyframe, QuadrantOf(o), *residual, 1.0 - 1.0 / count});
    }
    return all;
  }

  int QuadrantOf(const WindowData::PointObservation& o) const { return QuadrantOf(o.pixel); }
  int QuadrantOf(const WindowData::LineObservation& o) const {
    return QuadrantOf(o.segment.At(0.5));
  }
  int QuadrantOf(const Eigen::Vector2d& pixel) const {
    const PinholeCamera& camera = window_.camera;
    return (pixel.x() < 0.5 * camera.width ? 0 : 1) + (pixel.y() < 0.5 * camera.height ? 0 : 2);
  }

  const WindowResiduals& residuals_;
  const WindowData& window_;
};

// Standard deviation from the median of the absolute values.
double RobustDeviation(const Residuals& residuals) {
  std::vector<double> sizes;
  sizes.reserve(residuals.size());
  for (const Residual& residual : residuals) sizes.push_back(std::abs(residual.value));
  return UpperMedian(std::move(sizes)) / kNormalMedian;
}

double SumExpected(const Residuals& residuals) {
  double sum = 0.0;
  for (const Residual& residual : residuals) sum += residual.expected;
  return sum;
}

// Ratio of the variance of residuals to the expected one of independent errors.
struct VarianceRatio {
  double value = 1.0;
  int num_quadrants = 0;  // 0: no residuals
};

using Quadrant = std::pair<int64_t, int>;  // keyframe, quadrant of its image

// Variance ratio of single residuals, from their robust standard deviation.
VarianceRatio RatioOfSpread(const Residuals& residuals) {
  const double expected = SumExpected(residuals);
  if (expected <= 0.0) return {};
  std::set<Quadrant> quadrants;
  for (const Residual& residual : residuals) {
    quadrants.insert({residual.keyframe, residual.quadrant});
  }
  const double deviation = RobustDeviation(residuals);
  return {deviation * deviation * static_cast<double>(residuals.size()) / expected,
          static_cast<int>(quadrants.size())};
}

// Variance ratio of the sums of residuals over image quadrants.
VarianceRatio RatioOfQuadrantSums(const Residuals& residuals) {
  const double expected = SumExpected(residuals);
  if (expected <= 0.0) return {};
  const double bound = kMaxResidual * RobustDeviation(residuals);
  std::map<Quadrant, double> sums;
  for (const Residual& residual : residuals) {
    sums[{residual.keyframe, residual.quadrant}] += std::clamp(residual.value, -bound, bound);
  }
  double squares = 0.0;
  for (const auto& [quadrant, sum] : sums) squares += sum * sum;
  return {squares / expected, static_cast<int>(sums.size())};
}

}  // namespace

bool NoiseEstimatorOptions::IsValid(std::string* error) const {
  if (!(prior > 0.0 && prior <= kMemory)) {
    *error = FormatText("noise: prior must be positive and at most %g", kMemory);
    return false;
  }
  return true;
}

NoiseEstimator::NoiseEstimator(const NoiseEstimatorOptions& options) : options_(options) {
  std::string error;
  if (!options.IsValid(&error)) throw std::invalid_argument(error);
  for (Variance* variance : {&point_depth_, &line_pixel_, &line_depth_}) {
    variance->weight = options.prior;
  }
}

double NoiseEstimator::Scale(const Variance& variance) const {
  return std::clamp(std::sqrt(variance.value), 1.0 / kMaxScale, kMaxScale);
}

NoiseScale NoiseEstimator::scale() const {
  return {Scale(point_depth_), Scale(line_pixel_), Scale(line_depth_)};
}

void NoiseEstimator::Restore(const NoiseScale& scale) {
  point_depth_.value = scale.point_depth * scale.point_depth;
  line_pixel_.value = scale.line_pixel * scale.line_pixel;
  line_depth_.value = scale.line_depth * scale.line_depth;
}

void NoiseEstimator::Apply(WindowData* window) const {
  const NoiseScale scales = scale();
  for (WindowData::PointObservation& o : window->point_observations) {
    o.inverse_depth_sigma *= scales.point_depth;
  }
  for (WindowData::LineObservation& o : window->line_observations) {
    o.sigma *= scales.line_pixel;
    o.depth.covariance *= scales.line_depth * scales.line_depth;
  }
}

void NoiseEstimator::AddEstimate(double variance_ratio, int num_quadrants,
                                 Variance* variance) const {
  const double scale = Scale(*variance);
  const double total = variance->weight + num_quadrants;
  variance->value =
      (variance->weight * variance->value + num_quadrants * scale * scale * variance_ratio) / total;
  variance->weight = std::min(total, kMemory);
}

void NoiseEstimator::Update(const WindowResiduals& residuals) {
  if (!options_.enabled) return;
  const auto add = [this](const VarianceRatio& ratio, Variance* variance) {
    AddEstimate(ratio.value, ratio.num_quadrants, variance);
  };
  const ResidualCollector collector(residuals);
  add(RatioOfQuadrantSums(collector.PointDepths()), &point_depth_);
  add(RatioOfSpread(collector.LinePixels()), &line_pixel_);
  add(RatioOfQuadrantSums(collector.LineDepths()), &line_depth_);
}

}  // namespace msc_vo
