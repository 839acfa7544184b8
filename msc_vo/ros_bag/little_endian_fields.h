// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>

namespace msc_vo {

/// Reads packed fields in little-endian order, as bags of ROS 1 and MCAP files have them; the host
/// is little-endian, as for the rest of msc_vo. Views point into the bytes. All functions throw
/// std::runtime_error if the bytes end too early.
class LittleEndianFields {
 public:
  explicit LittleEndianFields(std::string_view bytes) : bytes_(bytes) {}

  template <typename Number>
  Number Read() {
    Number value;
    std::memcpy(&value, Take(sizeof(value)).data(), sizeof(value));
    return value;
  }
  std::string_view Take(size_t count) {
    if (count > bytes_.size()) throw std::runtime_error("the data end too early");
    const std::string_view taken = bytes_.substr(0, count);
    bytes_.remove_prefix(count);
    return taken;
  }
  /// An array of bytes after its length.
  std::string_view ReadArray() { return Take(Read<uint32_t>()); }
  std::string ReadString() { return std::string(ReadArray()); }
  size_t size() const { return bytes_.size(); }

 private:
  std::string_view bytes_;
};

}  // namespace msc_vo
