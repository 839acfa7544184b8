// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

namespace msc_vo {

/// Statistics of errors, which are not negative. All zero if there are no samples.
struct ErrorStatistics {
  int count = 0;
  double rmse = 0.0;
  double mean = 0.0;
  double median = 0.0;  ///< mean of the two middle values if the count is even
  double p95 = 0.0;     ///< 95th percentile: the smallest sample that 95 % of all do not exceed
  double max = 0.0;
};

ErrorStatistics StatisticsOf(std::vector<double> values);

}  // namespace msc_vo
