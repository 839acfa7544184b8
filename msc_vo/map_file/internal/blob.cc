// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/map_file/internal/blob.h"

#include <cmath>
#include <cstring>

#include <Eigen/Core>

namespace msc_vo {

namespace {

constexpr int kPixelBits = 24;
constexpr double kPixelUnits = 256.0;  // per pixel

template <typename To, typename From>
To BitCast(const From& from) {
  static_assert(sizeof(To) == sizeof(From));
  To to;
  std::memcpy(&to, &from, sizeof(to));
  return to;
}

double Finite(double value) {
  if (!std::isfinite(value)) throw BlobError("a number that is not finite");
  return value;
}

}  // namespace

void BlobWriter::Put(uint64_t value, int num_bytes) {
  for (int i = 0; i < num_bytes; ++i) U8(static_cast<uint8_t>(value >> (8 * i)));
}

void BlobWriter::F32(double value) { Put(BitCast<uint32_t>(static_cast<float>(value)), 4); }

void BlobWriter::F64(double value) { Put(BitCast<uint64_t>(value), 8); }

void BlobWriter::F16(double value) {
  U16(Eigen::numext::bit_cast<uint16_t>(Eigen::half(static_cast<float>(value))));
}

void BlobWriter::Pixel(double value) {
  const double units = std::round(value * kPixelUnits);
  if (!(std::abs(units) < (1 << (kPixelBits - 1)))) {
    throw std::invalid_argument("map file: a feature is too far outside the image");
  }
  Put(static_cast<uint64_t>(static_cast<int64_t>(units)), kPixelBits / 8);
}

void BlobWriter::Varint(int64_t value) {
  uint64_t rest = (static_cast<uint64_t>(value) << 1) ^ static_cast<uint64_t>(value >> 63);
  for (; rest >= 0x80; rest >>= 7) U8(static_cast<uint8_t>(rest | 0x80));
  U8(static_cast<uint8_t>(rest));
}

uint64_t BlobReader::Get(int num_bytes) {
  if (bytes_.size() < static_cast<size_t>(num_bytes)) throw BlobError("too few bytes");
  uint64_t value = 0;
  for (int i = 0; i < num_bytes; ++i) {
    value |= static_cast<uint64_t>(static_cast<uint8_t>(bytes_[i])) << (8 * i);
  }
  bytes_.remove_prefix(num_bytes);
  return value;
}

double BlobReader::F32() { return Finite(BitCast<float>(static_cast<uint32_t>(Get(4)))); }

double BlobReader::F64() { return Finite(BitCast<double>(Get(8))); }

double BlobReader::F16() {
  return Finite(static_cast<float>(Eigen::numext::bit_cast<Eigen::half>(U16())));
}

double BlobReader::Pixel() {
  const auto units = static_cast<int32_t>(Get(kPixelBits / 8) << (32 - kPixelBits));
  return (units >> (32 - kPixelBits)) / kPixelUnits;
}

int64_t BlobReader::Varint() {
  uint64_t value = 0;
  for (int shift = 0; shift < 64; shift += 7) {
    const uint8_t byte = U8();
    value |= static_cast<uint64_t>(byte & 0x7f) << shift;
    if (byte < 0x80) return static_cast<int64_t>(value >> 1) ^ -static_cast<int64_t>(value & 1);
  }
  throw BlobError("a number of more than 64 bits");
}

}  // namespace msc_vo
