// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/report/plot_range.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace msc_vo {

void Include(double value, PlotRange* range) {
  if (!std::isfinite(value)) return;
  range->min = std::min(range->min, value);
  range->max = std::max(range->max, value);
}

void IncludeMost(std::vector<double> values, double cut, PlotRange* range) {
  values.erase(std::remove_if(values.begin(), values.end(),
                              [](double value) { return !std::isfinite(value); }),
               values.end());
  if (values.empty()) return;
  std::sort(values.begin(), values.end());
  const auto num_cut = static_cast<size_t>(cut * static_cast<double>(values.size()));
  Include(values[num_cut], range);
  Include(values[values.size() - 1 - num_cut], range);
}

PlotRange Cover(const std::vector<double>& all, std::vector<double> most, double cut) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  PlotRange range{kInfinity, -kInfinity};
  for (const double value : all) Include(value, &range);
  IncludeMost(std::move(most), cut, &range);
  return range.min > range.max ? PlotRange{0.0, 0.0} : range;
}

}  // namespace msc_vo
