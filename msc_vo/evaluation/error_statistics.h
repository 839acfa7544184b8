// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

namespace msc_vo {

/// Statistics of errors, which are not negative, in the unit of the samples. All zero if there are
/// no samples.
struct ErrorStatistics {
  int count = 0;
  double rmse = 0.0;
  double mean = 0.0;
  double median = 0.0;  ///< mean of the two middle values if the count is even
  double p95 = 0.0;     ///< 95th percentile: the smallest sample that 95 % of all do not exceed
  double max = 0.0;
  double min = 0.0;
  double std = 0.0;  ///< standard deviation: RMS of the differences from the mean
  double sse = 0.0;  ///< sum of the squared samples, in the squared unit
};

/// Computes the statistics of the samples, which may be in any order.
ErrorStatistics StatisticsOf(std::vector<double> values);

}  // namespace msc_vo
