// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/image_files/png_filter.h"

#include <algorithm>
#include <cstdlib>
#include <vector>

namespace msc_vo {

namespace {

// Filters of rows whose pixels have kBytes bytes. `above` is the row above, zeros above the first
// one.
template <int kBytes>
struct Filters {
  static void Sub(size_t num_bytes, uint8_t* row) {
    for (size_t i = kBytes; i < num_bytes; ++i) row[i] = Sum(row[i], row[i - kBytes]);
  }

  static void Average(const uint8_t* above, size_t num_bytes, uint8_t* row) {
    for (size_t i = 0; i < kBytes; ++i) row[i] = Sum(row[i], above[i] / 2);
    for (size_t i = kBytes; i < num_bytes; ++i) {
      row[i] = Sum(row[i], (row[i - kBytes] + above[i]) / 2);
    }
  }

  // The neighbour nearest to left + above - above left; in that order if several are. Each byte of
  // the pixel is a chain of dependent steps: only what depends on the left neighbour is in it.
  static void Paeth(const uint8_t* above, size_t num_bytes, uint8_t* row) {
    int left[kBytes] = {};
    int corner[kBytes] = {};
    for (size_t i = 0; i < num_bytes; i += kBytes) {
      for (int k = 0; k < kBytes; ++k) {
        const int up = above[i + k];
        const int to_left = up - corner[k];
        const int to_up = left[k] - corner[k];
        const int left_distance = std::abs(to_left);
        const int up_distance = std::abs(to_up);
        const int corner_distance = std::abs(to_left + to_up);
        int nearest = up_distance <= corner_distance ? up : corner[k];
        nearest = left_distance <= std::min(up_distance, corner_distance) ? left[k] : nearest;
        left[k] = row[i + k] = Sum(row[i + k], nearest);
        corner[k] = up;
      }
    }
  }

  static bool Undo(int type, const uint8_t* above, size_t num_bytes, uint8_t* row) {
    switch (type) {
      case 0:
        return true;
      case 1:
        Sub(num_bytes, row);
        return true;
      case 2:
        for (size_t i = 0; i < num_bytes; ++i) row[i] = Sum(row[i], above[i]);
        return true;
      case 3:
        Average(above, num_bytes, row);
        return true;
      case 4:
        Paeth(above, num_bytes, row);
        return true;
      default:
        return false;
    }
  }

  static bool UndoAll(size_t num_bytes, int num_rows, uint8_t* rows) {
    const std::vector<uint8_t> zeros(num_bytes);
    const uint8_t* above = zeros.data();
    for (int i = 0; i < num_rows; ++i) {
      uint8_t* const row = rows + i * (num_bytes + 1) + 1;
      if (!Undo(row[-1], above, num_bytes, row)) return false;
      above = row;
    }
    return true;
  }

  static uint8_t Sum(int a, int b) { return static_cast<uint8_t>(a + b); }
};

}  // namespace

bool UndoPngFilters(int pixel_bytes, size_t row_bytes, int num_rows, uint8_t* rows) {
  switch (pixel_bytes) {
    case 1:
      return Filters<1>::UndoAll(row_bytes, num_rows, rows);
    case 2:
      return Filters<2>::UndoAll(row_bytes, num_rows, rows);
    case 3:
      return Filters<3>::UndoAll(row_bytes, num_rows, rows);
    case 4:
      return Filters<4>::UndoAll(row_bytes, num_rows, rows);
    default:
      return false;
  }
}

}  // namespace msc_vo
