// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/median_interval.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "msc_vo/geometry/quantile.h"

namespace msc_vo {

double MedianInterval(std::vector<double> stamps) {
  if (stamps.size() < 2) return 0.0;
  std::sort(stamps.begin(), stamps.end());
  std::vector<double> intervals;
  for (size_t i = 1; i < stamps.size(); ++i) intervals.push_back(stamps[i] - stamps[i - 1]);
  return UpperMedian(std::move(intervals));
}

}  // namespace msc_vo
