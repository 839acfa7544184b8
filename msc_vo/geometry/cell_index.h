// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

namespace msc_vo {

/// Returns the index of the cell that contains `position`, in units of cells, in a row of `count`
/// cells. Positions outside the row belong to the nearest cell, NaN to the first.
inline int CellIndex(double position, int count) {
  if (!(position > 0.0)) return 0;
  return position < count ? static_cast<int>(position) : count - 1;
}

}  // namespace msc_vo
