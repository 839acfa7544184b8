// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

namespace msc_vo {

/// Closed interval of one coordinate of a plot.
struct PlotRange {
  double min = 0.0;
  double max = 1.0;

  double Length() const { return max - min; }
};

/// Extends the range to contain the value, unless the value is not finite.
void Include(double value, PlotRange* range);

/// Extends the range to contain the finite values, except the fraction `cut` of the smallest and
/// the same fraction of the largest ones: outliers must not shrink the rest of a plot.
void IncludeMost(std::vector<double> values, double cut, PlotRange* range);

/// The smallest range that contains all finite values of `all`, and of `most` what IncludeMost()
/// keeps; [0, 0] if there are none.
PlotRange Cover(const std::vector<double>& all, std::vector<double> most, double cut);

}  // namespace msc_vo
