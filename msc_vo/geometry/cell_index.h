// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

namespace msc_vo {

// Index of the cell of a row of `count` cells that contains `position`, which counts cells. Safe
// for any position: those outside get the nearest cell, what is not a number the first.
inline int CellIndex(double position, int count) {
  if (!(position > 0.0)) return 0;
  return position < count ? static_cast<int>(position) : count - 1;
}

}  // namespace msc_vo
