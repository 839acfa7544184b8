// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

namespace msc_vo {

/// The keyframes that have a word: numbers in ascending order. Each takes one byte if it exceeds
/// the one before by less than 128, as most do if the word is frequent.
class PostingList {
 public:
  using Slot = uint32_t;
  static constexpr Slot kNoSlot = std::numeric_limits<Slot>::max();

  /// Adds a number that is larger than all in the list.
  void Append(Slot slot);
  /// Replaces each number by `new_slots[number]`, which must ascend, and removes it if that is
  /// kNoSlot.
  void Renumber(const std::vector<Slot>& new_slots);

  /// Lets the processor load the list, which will be read soon, into its cache.
  void Prefetch() const;

  /// Calls visit(slot) for all, in ascending order.
  template <typename Visit>
  void ForEach(const Visit& visit) const {
    const uint8_t* byte = bytes_.data();
    const uint8_t* const end = byte + bytes_.size();
    Slot slot = 0;
    while (byte != end) {
      if (end - byte >= 4 && AreSingleBytes(byte)) {
        for (int i = 0; i < 4; ++i) visit(slot += byte[i]);
        byte += 4;
      } else {
        visit(slot += ReadGap(&byte));
      }
    }
  }

 private:
  // Bytes of a gap have seven bits each, the least significant first; all but the last have kMore.
  static constexpr uint8_t kMore = 0x80;

  // Whether four bytes are four gaps.
  static bool AreSingleBytes(const uint8_t* bytes) {
    uint32_t four = 0;
    std::memcpy(&four, bytes, sizeof(four));
    return (four & 0x01010101u * kMore) == 0;
  }

  static Slot ReadGap(const uint8_t** byte) {
    Slot gap = 0;
    for (int shift = 0;; shift += 7) {
      const uint8_t bits = *(*byte)++;
      gap |= static_cast<Slot>(bits & ~kMore) << shift;
      if (bits < kMore) return gap;
    }
  }

  std::vector<uint8_t> bytes_;  // the first number, and the gaps between the others
  Slot last_ = 0;               // the largest number; 0: none
};

}  // namespace msc_vo
