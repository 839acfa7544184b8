// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace msc_vo {

/// Returns the p-quantile of the samples, 0 <= p <= 1; 0 if there are none.
template <typename T>
T Quantile(double p, std::vector<T> samples) {
  if (samples.empty()) return T();
  const auto nth =
      samples.begin() + static_cast<std::ptrdiff_t>(p * static_cast<double>(samples.size() - 1));
  std::nth_element(samples.begin(), nth, samples.end());
  return *nth;
}

/// Returns the median of the samples, the smaller of the two in the middle; 0 if there are none.
template <typename T>
T Median(std::vector<T> samples) {
  return Quantile(0.5, std::move(samples));
}

/// Returns the median of at least one sample, the larger of the two in the middle.
template <typename T>
T UpperMedian(std::vector<T> samples) {
  const auto middle = samples.begin() + static_cast<std::ptrdiff_t>(samples.size() / 2);
  std::nth_element(samples.begin(), middle, samples.end());
  return *middle;
}

}  // namespace msc_vo
