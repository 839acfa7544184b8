// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/image_files/png_filter.h"

#include <cstring>
#include <vector>

namespace msc_vo {

namespace {

enum Filter : uint8_t { kNone, kSub, kUp, kAverage, kPaeth };

// Sixteen bits for each byte of some pixels.
constexpr int kNumLanes = 8;
using Lanes [[gnu::vector_size(2 * kNumLanes)]] = int16_t;
using LaneBytes [[gnu::vector_size(kNumLanes)]] = uint8_t;

Lanes Load(const uint8_t* bytes) {
  LaneBytes loaded;
  std::memcpy(&loaded, bytes, sizeof loaded);
  return __builtin_convertvector(loaded, Lanes);
}

void Store(Lanes lanes, uint8_t* bytes) {
  const LaneBytes stored = __builtin_convertvector(lanes, LaneBytes);
  std::memcpy(bytes, &stored, sizeof stored);
}

Lanes Distance(Lanes a, Lanes b) { return (a > b ? a : b) - (a > b ? b : a); }

// The neighbour nearest to left + up - corner; in that order if several are.
Lanes Nearest(Lanes left, Lanes up, Lanes corner) {
  const Lanes left_distance = Distance(up, corner);
  const Lanes up_distance = Distance(left, corner);
  const Lanes corner_distance = Distance(left + up, corner + corner);
  const Lanes nearest = up_distance <= corner_distance ? up : corner;
  const Lanes other_distance = up_distance < corner_distance ? up_distance : corner_distance;
  return left_distance <= other_distance ? left : nearest;
}

// Undoes the Paeth filter of consecutive rows. One row alone is a chain of dependent steps, each
// pixel after the one to its left. Here a step is one pixel of each row, and each row is one pixel
// behind the row above it, where the pixel above is done by then.
template <int kPixelBytes>
class PaethRows {
  static constexpr int kPixelLanes = kPixelBytes == 3 ? 4 : kPixelBytes;

 public:
  static constexpr int kMaxRows = kNumLanes / kPixelLanes;

  explicit PaethRows(size_t width) : width_(width), steps_((width + kMaxRows) * kNumLanes) {}

  // `above`: the row above the first one. From one row to the next one are `stride` bytes.
  void Undo(const uint8_t* above, size_t stride, int num_rows, uint8_t* rows) {
    for (int i = 0; i < num_rows; ++i) {
      const uint8_t* const row = rows + i * stride;
      for (size_t x = 0; x < width_; ++x) {
        std::memcpy(LanesOf(i, x), row + x * kPixelBytes, kPixelBytes);
      }
    }
    UndoSteps(above);
    for (int i = 0; i < num_rows; ++i) {
      uint8_t* const row = rows + i * stride;
      for (size_t x = 0; x < width_; ++x) {
        std::memcpy(row + x * kPixelBytes, LanesOf(i, x), kPixelBytes);
      }
    }
  }

 private:
  uint8_t* LanesOf(int row, size_t x) { return &steps_[(x + row) * kNumLanes + row * kPixelLanes]; }

  void UndoSteps(const uint8_t* above) {
    Lanes left = {};
    Lanes corner = {};
    for (size_t x = 0; x < width_ + kMaxRows; ++x) {
      uint8_t* const step = &steps_[x * kNumLanes];
      Lanes up = MovedToRowBelow(left);
      for (int k = 0; k < kPixelBytes && x < width_; ++k) up[k] = above[x * kPixelBytes + k];
      left = (Load(step) + Nearest(left, up, corner)) & 0xFF;
      corner = up;
      Store(left, step);
    }
  }

  static Lanes MovedToRowBelow(Lanes lanes) {
    constexpr auto from = [](int lane) { return (lane + kNumLanes - kPixelLanes) % kNumLanes; };
    return __builtin_shufflevector(lanes, lanes, from(0), from(1), from(2), from(3), from(4),
                                   from(5), from(6), from(7));
  }

  size_t width_;                // pixels
  std::vector<uint8_t> steps_;  // pixel x of row i is in step x + i
};

// Filters of rows whose pixels have kBytes bytes. `above` is the row above, zeros above the first
// one.
template <int kBytes>
struct Filters {
  static void UndoSub(size_t num_bytes, uint8_t* row) {
    for (size_t i = kBytes; i < num_bytes; ++i) row[i] = Sum(row[i], row[i - kBytes]);
  }

  static void UndoUp(const uint8_t* above, size_t num_bytes, uint8_t* row) {
    for (size_t i = 0; i < num_bytes; ++i) row[i] = Sum(row[i], above[i]);
  }

  static void UndoAverage(const uint8_t* above, size_t num_bytes, uint8_t* row) {
    for (size_t i = 0; i < kBytes; ++i) row[i] = Sum(row[i], above[i] / 2);
    for (size_t i = kBytes; i < num_bytes; ++i) {
      row[i] = Sum(row[i], (row[i - kBytes] + above[i]) / 2);
    }
  }

  static bool UndoAll(size_t num_bytes, int num_rows, uint8_t* rows) {
    const size_t stride = num_bytes + 1;
    const std::vector<uint8_t> zeros(num_bytes);
    PaethRows<kBytes> paeth_rows(num_bytes / kBytes);
    const uint8_t* above = zeros.data();
    int num = 0;
    for (int i = 0; i < num_rows; i += num) {
      uint8_t* const row = rows + i * stride + 1;
      const int max_rows = row[-1] == kPaeth ? PaethRows<kBytes>::kMaxRows : 1;
      for (num = 1; num < max_rows && i + num < num_rows && row[num * stride - 1] == kPaeth;) ++num;
      switch (row[-1]) {
        case kNone:
          break;
        case kSub:
          UndoSub(num_bytes, row);
          break;
        case kUp:
          UndoUp(above, num_bytes, row);
          break;
        case kAverage:
          UndoAverage(above, num_bytes, row);
          break;
        case kPaeth:
          paeth_rows.Undo(above, stride, num, row);
          break;
        default:
          return false;
      }
      above = row + (num - 1) * stride;
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
