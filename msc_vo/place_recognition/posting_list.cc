// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/place_recognition/posting_list.h"

#include <algorithm>
#include <array>

namespace msc_vo {

void PostingList::Insert(Slot slot) {
  if (size_ == 0 || slot > last_) {
    Replace(bytes_.size(), bytes_.size(), {slot - last_});
    last_ = slot;
  } else {
    const Position next = Find(slot);
    Replace(next.begin, next.end, {slot - next.before, next.slot - slot});
  }
  ++size_;
}

void PostingList::Remove(Slot slot) {
  const Position removed = Find(slot);
  if (removed.end == bytes_.size()) {
    bytes_.resize(removed.begin);
    last_ = removed.before;
  } else {
    const uint8_t* byte = bytes_.data() + removed.end;
    const Slot gap = slot - removed.before + ReadGap(&byte);
    Replace(removed.begin, static_cast<size_t>(byte - bytes_.data()), {gap});
  }
  --size_;
}

void PostingList::Prefetch() const {
  constexpr size_t kCacheLine = 64;     // bytes
  constexpr size_t kMaxPrefetched = 8;  // cache lines; hardware loads the rest of a long list
  const size_t size = std::min(bytes_.size(), kMaxPrefetched * kCacheLine);
  for (size_t i = 0; i < size; i += kCacheLine) __builtin_prefetch(bytes_.data() + i);
}

PostingList::Position PostingList::Find(Slot slot) const {
  Position position;
  const uint8_t* byte = bytes_.data();
  const uint8_t* const end = byte + bytes_.size();
  do {
    while (end - byte >= 4 && AreSingleBytes(byte)) {
      const Slot fourth = position.slot + byte[0] + byte[1] + byte[2] + byte[3];
      if (fourth >= slot) break;
      position.slot = fourth;
      byte += 4;
    }
    position.begin = static_cast<size_t>(byte - bytes_.data());
    position.before = position.slot;
    position.slot += ReadGap(&byte);
  } while (position.slot < slot);
  position.end = static_cast<size_t>(byte - bytes_.data());
  return position;
}

void PostingList::Replace(size_t begin, size_t end, std::initializer_list<Slot> gaps) {
  constexpr size_t kMaxBytes = 5;  // of a gap
  std::array<uint8_t, 2 * kMaxBytes> replacement;
  size_t size = 0;
  for (Slot gap : gaps) {
    for (; gap >= kMore; gap >>= 7) replacement[size++] = static_cast<uint8_t>(gap | kMore);
    replacement[size++] = static_cast<uint8_t>(gap);
  }
  const auto place = bytes_.erase(bytes_.begin() + static_cast<std::ptrdiff_t>(begin),
                                  bytes_.begin() + static_cast<std::ptrdiff_t>(end));
  bytes_.insert(place, replacement.begin(), replacement.begin() + size);
}

}  // namespace msc_vo
