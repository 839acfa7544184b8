// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <cstring>

#include "msc_vo/geometry/avx2.h"

#define MSC_VO_INLINE [[gnu::always_inline]] inline

// Vectors are passed between inlined functions only, so no calling convention applies.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi"
#endif

namespace msc_vo {

/// 32 bytes (unsigned) that are processed at once: one vector with AVX2, otherwise two. A thin
/// wrapper over the vector extension of GCC and Clang; all operations are exact.
class ByteVector {
 public:
  static constexpr int kLanes = 32;

  /// All lanes are 0.
  MSC_VO_INLINE ByteVector() : lanes_{} {}
  /// All lanes are `value`.
  MSC_VO_INLINE explicit ByteVector(uint8_t value) : lanes_(Lanes{} + value) {}

  /// Reads kLanes bytes; no alignment is required.
  MSC_VO_INLINE static ByteVector Load(const uint8_t* from) {
    ByteVector vector;
    std::memcpy(&vector.lanes_, from, kLanes);
    return vector;
  }
  /// Writes kLanes bytes; no alignment is required.
  MSC_VO_INLINE void Store(uint8_t* to) const { std::memcpy(to, &lanes_, kLanes); }

  MSC_VO_INLINE friend ByteVector Min(const ByteVector& a, const ByteVector& b) {
    return ByteVector(a.lanes_ < b.lanes_ ? a.lanes_ : b.lanes_);
  }
  MSC_VO_INLINE friend ByteVector Max(const ByteVector& a, const ByteVector& b) {
    return ByteVector(a.lanes_ > b.lanes_ ? a.lanes_ : b.lanes_);
  }
  /// a - b, or 0 where b is larger.
  MSC_VO_INLINE friend ByteVector SubtractSaturated(const ByteVector& a, const ByteVector& b) {
    return ByteVector(Max(a, b).lanes_ - b.lanes_);
  }
  /// a where it exceeds `limit`, elsewhere 0.
  MSC_VO_INLINE friend ByteVector ZeroUnlessAbove(const ByteVector& a, const ByteVector& limit) {
    return ByteVector(a.lanes_ > limit.lanes_ ? a.lanes_ : Lanes{});
  }

 private:
  using Lanes [[gnu::vector_size(kLanes)]] = uint8_t;

  MSC_VO_INLINE explicit ByteVector(const Lanes& lanes) : lanes_(lanes) {}

  Lanes lanes_;
};

}  // namespace msc_vo

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic pop
#endif
