// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <string_view>
#include <type_traits>

namespace msc_vo {

/// Builds the bytes of a binary format with little-endian numbers.
class LittleEndianBytes {
 public:
  template <typename Number>
  LittleEndianBytes& Add(Number value) {
    static_assert(std::is_arithmetic_v<Number>);
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof(value));
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
