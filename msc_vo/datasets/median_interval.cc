// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/median_interval.h"

#include <algorithm>
#include <cstddef>

namespace msc_vo {

double MedianInterval(std::vector<double> stamps) {
  if (stamps.size() < 2) return 0.0;
  std::sort(stamps.begin(), stamps.end());
  std::vector<double> intervals;
  for (size_t i = 1; i < stamps.size(); ++i) intervals.push_back(stamps[i] - stamps[i - 1]);
  const auto middle = intervals.begin() + static_cast<std::ptrdiff_t>(intervals.size() / 2);
  std::nth_element(intervals.begin(), middle, intervals.end());
  return *middle;
}

}  // namespace msc_vo
