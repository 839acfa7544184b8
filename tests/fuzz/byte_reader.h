// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace msc_vo {

/// Interprets the bytes of an input as choices of a structure-aware target. Reads zeros after the
/// end, so that every input is complete.
class ByteReader {
 public:
  ByteReader(const uint8_t* data, size_t size) : data_(data), end_(data + size) {}

  bool AtEnd() const { return data_ == end_; }
  uint8_t Byte() { return AtEnd() ? uint8_t{0} : *data_++; }

  /// A number from 0 to count - 1; 0 if `count` is 0.
  size_t Below(size_t count) {
    const size_t low = Byte();
    const size_t value = low + (count > 256 ? size_t{256} * Byte() : 0);
    return count == 0 ? 0 : value % count;
  }

  /// A whole number: small, or at the limits of its type.
  int64_t Integer() {
    constexpr std::array<int64_t, 6> kLimits = {std::numeric_limits<int64_t>::min(),
                                                std::numeric_limits<int64_t>::max(),
                                                std::numeric_limits<int>::min(),
                                                std::numeric_limits<int>::max(),
                                                int64_t{1} << 20,
                                                -1};
    const size_t choice = Below(2 * kLimits.size());
    return choice < kLimits.size() ? kLimits[choice] : static_cast<int64_t>(Byte());
  }

  /// A number that replaces `value`: hostile, arbitrary, or close to `value`.
  double NumberFor(double value) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    constexpr std::array<double, 20> kHostile = {
        0.0,  -0.0,  1.0,    -1.0, std::numeric_limits<double>::quiet_NaN(),
        1e9,  -1e9,  1e-9,   2e9,  std::numeric_limits<double>::denorm_min(),
        1e18, 1e-18, 1e-160, 0.5,  std::numeric_limits<double>::max(),
        1e38, 1e150, 1e-300, 1e6,  kInfinity};
    const size_t choice = Below(64);
    if (choice < kHostile.size()) return kHostile[choice];
    if (choice < 24) return Arbitrary();
    const double amount = (static_cast<int>(Byte()) - 128) / 64.0;  // -2 to 2
    if (choice < 40) return value * std::pow(10.0, 3.0 * amount);
    if (choice < 50) return value + amount;
    return value * (1.0 + 1e-3 * amount);
  }

 private:
  double Arbitrary() {
    uint64_t bits = 0;
    for (int i = 0; i < 8; ++i) bits = bits << 8 | Byte();
    double value = 0.0;
    std::memcpy(&value, &bits, sizeof(value));
    return value;
  }

  const uint8_t* data_;
  const uint8_t* end_;
};

}  // namespace msc_vo
