// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <vector>

namespace msc_vo {

/// The keyframes that have a word: different numbers in ascending order. Each takes one byte if it
/// exceeds the one before by less than 128, as most do if the word is frequent.
class PostingList {
 public:
  using Slot = uint32_t;

  int size() const { return static_cast<int>(size_); }

  /// Adds a number that is not in the list. Constant time if it is the largest, otherwise linear.
  void Insert(Slot slot);
  /// Removes a number that is in the list. Linear time.
  void Remove(Slot slot);

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

  // Where an element is in `bytes_`.
  struct Position {
    size_t begin = 0, end = 0;
    Slot before = 0;  // the element before it; 0: none
    Slot slot = 0;
  };
  // The first element that is not less than `slot`, which is at most `last_`.
  Position Find(Slot slot) const;
  // Replaces bytes by those of at most two gaps.
  void Replace(size_t begin, size_t end, std::initializer_list<Slot> gaps);

  std::vector<uint8_t> bytes_;
  uint32_t size_ = 0;
  Slot last_ = 0;  // the largest
};

}  // namespace msc_vo
