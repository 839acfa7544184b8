// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/evaluation/error_statistics.h"

#include <algorithm>
#include <cmath>

namespace msc_vo {

ErrorStatistics StatisticsOf(std::vector<double> values) {
  ErrorStatistics statistics;
  statistics.count = static_cast<int>(values.size());
  if (values.empty()) return statistics;
  std::sort(values.begin(), values.end());
  double sum = 0.0;
  double sum_of_squares = 0.0;
  for (const double value : values) {
    sum += value;
    sum_of_squares += value * value;
  }
  const size_t middle = values.size() / 2;
  statistics.rmse = std::sqrt(sum_of_squares / statistics.count);
  statistics.mean = sum / statistics.count;
  statistics.median =
      values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
  statistics.p95 = values[(95 * values.size() + 99) / 100 - 1];
  statistics.max = values.back();
  statistics.min = values.front();
  statistics.sse = sum_of_squares;
  double sum_of_deviations = 0.0;
  for (const double value : values) {
    sum_of_deviations += (value - statistics.mean) * (value - statistics.mean);
  }
  statistics.std = std::sqrt(sum_of_deviations / statistics.count);
  return statistics;
}

}  // namespace msc_vo
