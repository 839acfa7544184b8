// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace msc_vo {

/// Serialises the fields of a message of ROS 2 in CDR, the lowest byte first on any machine.
class CdrWriter {
 public:
  CdrWriter();
  ~CdrWriter();
  CdrWriter(const CdrWriter&) = delete;
  CdrWriter& operator=(const CdrWriter&) = delete;

  CdrWriter& AddByte(uint8_t value);
  CdrWriter& AddWord(uint32_t value);
  CdrWriter& AddInt(int32_t value);
  CdrWriter& AddFloat(float value);
  CdrWriter& AddDouble(double value);
  CdrWriter& AddString(const std::string& text);
  /// Adds a sequence of bytes with its length.
  CdrWriter& AddBytes(std::string_view bytes);
  template <typename Numbers>
  CdrWriter& AddDoubles(const Numbers& values) {
    for (const double value : values) AddDouble(value);
    return *this;
  }
  /// The message so far.
  std::string Message() const;

 private:
  struct Stream;
  std::unique_ptr<Stream> stream_;
};

}  // namespace msc_vo
