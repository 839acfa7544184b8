// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/place_recognition/posting_list.h"

#include <algorithm>
#include <utility>

namespace msc_vo {

void PostingList::Append(Slot slot) {
  Slot gap = slot - std::exchange(last_, slot);
  for (; gap >= kMore; gap >>= 7) bytes_.push_back(static_cast<uint8_t>(gap | kMore));
  bytes_.push_back(static_cast<uint8_t>(gap));
}

void PostingList::Renumber(const std::vector<Slot>& new_slots) {
  PostingList renumbered;
  ForEach([&](Slot slot) {
    if (new_slots[slot] != kNoSlot) renumbered.Append(new_slots[slot]);
  });
  renumbered.bytes_.shrink_to_fit();
  *this = std::move(renumbered);
}

void PostingList::Prefetch() const {
  constexpr size_t kCacheLine = 64;     // bytes
  constexpr size_t kMaxPrefetched = 8;  // cache lines; hardware loads the rest of a long list
  const size_t size = std::min(bytes_.size(), kMaxPrefetched * kCacheLine);
  for (size_t i = 0; i < size; i += kCacheLine) __builtin_prefetch(bytes_.data() + i);
}

}  // namespace msc_vo
