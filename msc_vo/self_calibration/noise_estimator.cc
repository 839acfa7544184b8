// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/self_calibration/noise_estimator.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <vector>

namespace msc_vo {

namespace {

// Residuals of depths count up to this many robust standard deviations: single gross errors (an
// edge, a mirror) are left to the solver's own tests.
constexpr double kMaxResidual = 3.0;
// Median of the absolute value of a standard normal variable.
constexpr double kNormalMedian = 0.6745;

struct Residual {
  int64_t keyframe = 0;
  int quarter = 0;     // of its image
  double value = 0.0;  // in sigmas
  // Its variance, if errors were independent: the landmark has cost its n measurements of a number
  // one degree of freedom.
  double expected = 0.0;  // 1 - 1 / n
};
using Residuals = std::vector<Residual>;

// Residuals of one kind.
class ResidualReader {
 public:
  explicit ResidualReader(const WindowResiduals& residuals)
      : residuals_(residuals), window_(residuals.window()) {}

  Residuals PointDepths() const {
    return Depths(window_.point_observations, window_.points.size(), &WindowResiduals::PointOf,
                  &WindowResiduals::PointDepth);
  }
  Residuals LineDepths() const {
    return Depths(window_.line_observations, window_.lines.size(), &WindowResiduals::LineOf,
                  &WindowResiduals::LineDepth);
  }

  // Of both end points. Rejected observations are part of it, as otherwise a sigma that is too
  // small would reject what contradicts it; they have cost nothing.
  Residuals LinePixels() const {
    const auto& observations = window_.line_observations;
    std::vector<int> num_accepted(window_.lines.size(), 0);
    for (size_t i = 0; i < observations.size(); ++i) {
      num_accepted[residuals_.LineOf(i)] += !observations[i].rejected;
    }
    Residuals all;
    all.reserve(2 * observations.size());
    for (size_t i = 0; i < observations.size(); ++i) {
      const WindowData::LineObservation& o = observations[i];
      const std::optional<Eigen::Vector2d> residual = residuals_.LinePixel(i);
      if (!residual) continue;
      const double expected = o.rejected ? 1.0 : 1.0 - 1.0 / num_accepted[residuals_.LineOf(i)];
      for (const int end : {0, 1}) {
        all.push_back({o.keyframe, QuarterOf(o), (*residual)[end], expected});
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
      all.push_back({o.keyframe, QuarterOf(o), *residual, 1.0 - 1.0 / count});
    }
    return all;
  }

  int QuarterOf(const WindowData::PointObservation& o) const { return QuarterOf(o.pixel); }
  int QuarterOf(const WindowData::LineObservation& o) const { return QuarterOf(o.segment.At(0.5)); }
  int QuarterOf(const Eigen::Vector2d& pixel) const {
    const PinholeCamera& camera = window_.camera;
    return (pixel.x() < 0.5 * camera.width ? 0 : 1) + (pixel.y() < 0.5 * camera.height ? 0 : 2);
  }

  const WindowResiduals& residuals_;
  const WindowData& window_;
};

// Standard deviation by the median of the absolute values.
double RobustDeviation(const Residuals& residuals) {
  std::vector<double> sizes;
  sizes.reserve(residuals.size());
  for (const Residual& residual : residuals) sizes.push_back(std::abs(residual.value));
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return *middle / kNormalMedian;
}

double SumOfExpected(const Residuals& residuals) {
  double sum = 0.0;
  for (const Residual& residual : residuals) sum += residual.expected;
  return sum;
}

// Variance of residuals, relative to that of independent errors with their sigmas.
struct Evidence {
  double variance = 1.0;
  int num_quarters = 0;  // 0: there is none
};

using Quarter = std::pair<int64_t, int>;  // keyframe, quarter of its image

// By the spread of the residuals' middle half.
Evidence OfSpread(const Residuals& residuals) {
  const double expected = SumOfExpected(residuals);
  if (expected <= 0.0) return {};
  std::set<Quarter> quarters;
  for (const Residual& residual : residuals) {
    quarters.insert({residual.keyframe, residual.quarter});
  }
  const double deviation = RobustDeviation(residuals);
  return {deviation * deviation * static_cast<double>(residuals.size()) / expected,
          static_cast<int>(quarters.size())};
}

// By the sums over quarters of images: the mean of their squares.
Evidence OfSums(const Residuals& residuals) {
  const double expected = SumOfExpected(residuals);
  if (expected <= 0.0) return {};
  const double bound = kMaxResidual * RobustDeviation(residuals);
  std::map<Quarter, double> sums;
  for (const Residual& residual : residuals) {
    sums[{residual.keyframe, residual.quarter}] += std::clamp(residual.value, -bound, bound);
  }
  double squares = 0.0;
  for (const auto& [where, sum] : sums) squares += sum * sum;
  return {squares / expected, static_cast<int>(sums.size())};
}

}  // namespace

bool NoiseEstimatorOptions::IsValid(std::string* error) const {
  if (!(prior > 0.0 && memory >= prior)) {
    *error = "noise: prior must be positive, and memory not less";
  } else if (!(max_scale >= 1.0)) {
    *error = "noise.max_scale must be at least 1";
  } else {
    return true;
  }
  return false;
}

NoiseEstimator::NoiseEstimator(const NoiseEstimatorOptions& options) : options_(options) {
  std::string error;
  if (!options.IsValid(&error)) throw std::invalid_argument(error);
  for (Variance* variance : {&point_depth_, &line_pixel_, &line_depth_}) {
    variance->weight = options.prior;
  }
}

double NoiseEstimator::Scale(const Variance& variance) const {
  return std::clamp(std::sqrt(variance.value), 1.0 / options_.max_scale, options_.max_scale);
}

NoiseScale NoiseEstimator::scale() const {
  return {Scale(point_depth_), Scale(line_pixel_), Scale(line_depth_)};
}

void NoiseEstimator::Apply(WindowData* window) const {
  const NoiseScale by = scale();
  for (WindowData::PointObservation& o : window->point_observations) {
    o.inverse_depth_sigma *= by.point_depth;
  }
  for (WindowData::LineObservation& o : window->line_observations) {
    o.sigma *= by.line_pixel;
    o.depth.covariance *= by.line_depth * by.line_depth;
  }
}

void NoiseEstimator::Update(const WindowResiduals& residuals) {
  if (!options_.enabled) return;
  const auto learn = [this](const Evidence& evidence, Variance* variance) {
    const double scale = Scale(*variance);  // the window was whitened with it
    const double total = variance->weight + evidence.num_quarters;
    variance->value = (variance->weight * variance->value +
                       evidence.num_quarters * scale * scale * evidence.variance) /
                      total;
    variance->weight = std::min(total, options_.memory);
  };
  const ResidualReader reader(residuals);
  learn(OfSums(reader.PointDepths()), &point_depth_);
  learn(OfSpread(reader.LinePixels()), &line_pixel_);
  learn(OfSums(reader.LineDepths()), &line_depth_);
}

}  // namespace msc_vo
