// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/sensor/depth_statistics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "msc_vo/geometry/quantile.h"

namespace msc_vo {

namespace {

constexpr int kMinSamples = 2000;
constexpr int kMeasuredRowStep = 2;  // every second row is measured
// Largest number of samples of the resolution, which are sorted.
constexpr size_t kMaxLevels = 20000;
constexpr double kMaxDepth = 8.0;  // metres; farther away, noise is that of failing measurements
// First quartile of the absolute value of a standard normal variable. Quartiles measure the noise
// of the smoother surfaces where the others are no planes.
constexpr double kNormalQuartile = 0.3186;
// Standard deviation of a second difference of independent values: sqrt(1 + 4 + 1).
constexpr double kSecondDifference = 2.4495;
// Bins of depth in which the exponent is measured.
constexpr int kNumBins = 6;
// Part of the samples in the bins, nearest first: beyond, flying pixels of time of flight cover
// whole surfaces at a flat angle. Correlated noise has none.
constexpr double kWhiteRatio = 0.6;
constexpr double kCorrelatedPart = 0.95;
// Smallest ratio of the depths of two bins whose noise is compared.
constexpr double kMinDepthRatio = 1.15;
// Smallest ratio of the farthest to the nearest bin that tells the exponent.
constexpr double kMinDepthRange = 1.3;

// Limits of the classes, between values measured on real and on simulated sensors, see
// docs/lab/depth.md. Noise below 1e-4 1/m is that of rounding: 1 mm at 3 m.
constexpr double kExactNoise = 1e-4;
constexpr double kQuantizedNoise = 2.0;  // noise in steps; a Kinect has at most 1.3
constexpr double kCorrelatedRatio = 3.0;
constexpr double kRangeExponent = 1.4;
// 1/metres; correlated noise of stereo is above, that of a LiDAR and of exact depth that was
// registered to another camera below.
constexpr double kSmoothNoise = 1e-3;

struct Difference {
  float z = 0.0f;      // metres
  float value = 0.0f;  // absolute second difference of inverse depth, 1/metres
};

bool IsMeasured(float z) { return z > 0.0f && z < kMaxDepth; }

std::vector<Difference> SecondDifferences(const cv::Mat& depth, int lag) {
  std::vector<Difference> differences;
  for (int y = 0; y < depth.rows; y += kMeasuredRowStep) {
    const float* z = depth.ptr<float>(y);
    for (int x = lag; x + lag < depth.cols; ++x) {
      if (!IsMeasured(z[x - lag]) || !IsMeasured(z[x]) || !IsMeasured(z[x + lag])) continue;
      const double value = 1.0 / z[x - lag] - 2.0 / z[x] + 1.0 / z[x + lag];
      differences.push_back({z[x], static_cast<float>(std::abs(value))});
    }
  }
  return differences;
}

double NoiseOf(const std::vector<Difference>& differences) {
  std::vector<float> values;
  values.reserve(differences.size());
  for (const Difference& difference : differences) values.push_back(difference.value);
  return Quantile(0.25, std::move(values)) / (kNormalQuartile * kSecondDifference);
}

// Median over the samples of the farther half of the distance from their value to the next larger
// one.
double StepOf(const std::vector<Difference>& differences) {
  std::vector<float> depths;
  depths.reserve(differences.size());
  for (const Difference& difference : differences) depths.push_back(difference.z);
  const double middle = Median(depths);
  std::vector<float> sorted;
  const size_t stride = std::max<size_t>(1, depths.size() / kMaxLevels);
  for (size_t i = 0; i < depths.size(); i += stride) {
    if (depths[i] >= middle) sorted.push_back(1.0f / depths[i]);
  }
  std::sort(sorted.begin(), sorted.end());
  std::vector<float> steps;
  float next = 0.0f;  // the next larger value than the current one
  for (size_t i = sorted.size(); i-- > 0;) {
    if (i + 1 < sorted.size() && sorted[i + 1] > sorted[i]) next = sorted[i + 1];
    if (next > 0.0f) steps.push_back(next - sorted[i]);
  }
  return Median(std::move(steps));
}

// Median of the slopes, in logarithms, between bins of the nearest samples; `ratio` of them are
// used.
std::optional<double> ExponentOf(std::vector<Difference> differences, double ratio) {
  std::sort(differences.begin(), differences.end(),
            [](const Difference& a, const Difference& b) { return a.z < b.z; });
  const auto used = static_cast<size_t>(ratio * static_cast<double>(differences.size()));
  std::array<double, kNumBins> depths{}, sigmas{};
  for (int bin = 0; bin < kNumBins; ++bin) {
    std::vector<float> values;
    const size_t begin = used * bin / kNumBins, end = used * (bin + 1) / kNumBins;
    for (size_t i = begin; i < end; ++i) values.push_back(differences[i].value);
    depths[bin] = differences[(begin + end) / 2].z;
    const double sigma = Quantile(0.25, std::move(values)) / (kNormalQuartile * kSecondDifference);
    sigmas[bin] = sigma * depths[bin] * depths[bin];
  }
  if (depths.back() < kMinDepthRange * depths.front()) return std::nullopt;
  std::vector<float> slopes;
  for (int a = 0; a < kNumBins; ++a) {
    for (int b = a + 1; b < kNumBins; ++b) {
      if (depths[b] < kMinDepthRatio * depths[a] || sigmas[a] <= 0.0 || sigmas[b] <= 0.0) continue;
      slopes.push_back(
          static_cast<float>(std::log(sigmas[b] / sigmas[a]) / std::log(depths[b] / depths[a])));
    }
  }
  if (slopes.empty()) return std::nullopt;
  return Median(std::move(slopes));
}

bool IsCorrelated(const DepthStatistics& statistics) {
  return statistics.far_noise > kCorrelatedRatio * statistics.near_noise;
}

}  // namespace

DepthStatistics MeasureDepthStatistics(const cv::Mat& depth) {
  DepthStatistics statistics;
  const std::vector<Difference> near = SecondDifferences(depth, 1);
  const std::vector<Difference> far = SecondDifferences(depth, std::max(2, depth.cols / 80));
  statistics.num_samples = static_cast<int>(std::min(near.size(), far.size()));
  if (statistics.num_samples < kMinSamples) return statistics;
  statistics.near_noise = NoiseOf(near);
  statistics.far_noise = NoiseOf(far);
  statistics.step = StepOf(near);
  statistics.exponent =
      IsCorrelated(statistics) ? ExponentOf(far, kCorrelatedPart) : ExponentOf(near, kWhiteRatio);
  return statistics;
}

DepthSensor ClassifyDepthSensor(const DepthStatistics& statistics) {
  if (statistics.num_samples < kMinSamples) return DepthSensor::kAuto;
  if (statistics.far_noise < std::max(kExactNoise, kQuantizedNoise * statistics.step)) {
    return DepthSensor::kStructuredLight;
  }
  const std::optional<double>& exponent = statistics.exponent;
  if (IsCorrelated(statistics)) {
    if (statistics.far_noise > kSmoothNoise) return DepthSensor::kStereo;
    return exponent.value_or(0.0) < kRangeExponent ? DepthSensor::kLidar
                                                   : DepthSensor::kStructuredLight;
  }
  if (!exponent) return DepthSensor::kAuto;
  return *exponent < kRangeExponent ? DepthSensor::kTimeOfFlight : DepthSensor::kStructuredLight;
}

}  // namespace msc_vo
