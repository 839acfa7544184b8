// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

namespace msc_vo {

/// Thresholds of the squared norm of a whitened residual, by its number of rows (the index): 99 %
/// quantiles of chi-square, above which it is an outlier.
constexpr double kOutlierChiSquare[] = {0.0, 6.635, 9.210, 11.345, 13.277, 15.086, 16.812};

/// Huber thresholds, in standard deviations, by the number of rows: square roots of the 95 %
/// quantiles of chi-square.
constexpr double kHuberThreshold[] = {0.0, 1.960, 2.448, 2.795};

}  // namespace msc_vo
