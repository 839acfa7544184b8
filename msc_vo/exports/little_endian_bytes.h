// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>

namespace msc_vo {

/// Builds the bytes of a binary format, numbers with their lowest byte first on any machine.
class LittleEndianBytes {
 public:
  /// Adds a number of 1, 2, 4 or 8 bytes.
  template <typename Number>
  LittleEndianBytes& Add(Number value) {
    static_assert(sizeof(value) <= sizeof(uint64_t), "a number");
    uint64_t bits = 0;
    if constexpr (sizeof(value) == sizeof(float) && !std::is_integral_v<Number>) {
      uint32_t word = 0;
      std::memcpy(&word, &value, sizeof(word));
      bits = word;
    } else if constexpr (!std::is_integral_v<Number>) {
      std::memcpy(&bits, &value, sizeof(value));
    } else {
      bits = static_cast<uint64_t>(value);
    }
    for (size_t i = 0; i < sizeof(value); ++i) {
      bytes_ += static_cast<char>((bits >> (8 * i)) & 0xFFU);
    }
    return *this;
  }
  /// Adds bytes as they are.
  LittleEndianBytes& Append(std::string_view bytes) {
    bytes_ += bytes;
    return *this;
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

}  // namespace msc_vo
