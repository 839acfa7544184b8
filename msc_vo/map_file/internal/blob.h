// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <array>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

namespace msc_vo {

/// Thrown for bytes that are not what a blob of a map contains.
class BlobError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Throws BlobError with `problem` unless it holds.
inline void Require(bool holds, const char* problem) {
  if (!holds) throw BlobError(problem);
}

/// Writes numbers into a blob of a map, least significant byte first (docs/map_file.md).
class BlobWriter {
 public:
  void U8(uint8_t value) { bytes_.push_back(static_cast<char>(value)); }
  void U16(uint16_t value) { Put(value, 2); }
  void F32(double value);
  void F64(double value);
  /// 16-bit floating point number.
  void F16(double value);
  /// A coordinate in the image: 24 bits, in 1/256 pixel. Throws std::invalid_argument if it is
  /// outside their range.
  void Pixel(double value);
  /// Variable number of bytes with seven bits each, of a number whose sign is its lowest bit.
  void Varint(int64_t value);
  template <size_t size>
  void Bytes(const std::array<uint8_t, size>& bytes) {
    bytes_.append(reinterpret_cast<const char*>(bytes.data()), size);
  }

  const std::string& bytes() const { return bytes_; }

 private:
  void Put(uint64_t value, int num_bytes);

  std::string bytes_;
};

/// Reads what BlobWriter has written. Throws BlobError at the end of the bytes, and on numbers that
/// are not finite.
class BlobReader {
 public:
  /// `bytes` must outlive the reader.
  explicit BlobReader(std::string_view bytes) : bytes_(bytes) {}

  bool AtEnd() const { return bytes_.empty(); }
  size_t size() const { return bytes_.size(); }  ///< bytes left

  uint8_t U8() { return static_cast<uint8_t>(Get(1)); }
  uint16_t U16() { return static_cast<uint16_t>(Get(2)); }
  double F32();
  double F64();
  double F16();
  double Pixel();
  int64_t Varint();
  template <size_t size>
  void Bytes(std::array<uint8_t, size>* bytes) {
    for (uint8_t& byte : *bytes) byte = U8();
  }

 private:
  uint64_t Get(int num_bytes);

  std::string_view bytes_;
};

}  // namespace msc_vo
