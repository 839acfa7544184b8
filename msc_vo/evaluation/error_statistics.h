// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

namespace msc_vo {

// Of the absolute values of one kind of error. All zero if there are no samples.
struct ErrorStatistics {
  int count = 0;
  double rmse = 0.0;
  double mean = 0.0;
  double median = 0.0;  // the mean of the two in the middle if the count is even
  double p95 = 0.0;     // the least value that 95 % of all do not exceed
  double max = 0.0;
};

ErrorStatistics StatisticsOf(std::vector<double> values);

}  // namespace msc_vo
