// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/place_recognition/posting_list.h"

#include <random>
#include <vector>

#include <gmock/gmock.h>

namespace msc_vo {
namespace {

std::vector<uint32_t> ContentsOf(const PostingList& list) {
  std::vector<uint32_t> contents;
  list.ForEach([&contents](uint32_t slot) { contents.push_back(slot); });
  return contents;
}

PostingList ListOf(const std::vector<uint32_t>& slots) {
  PostingList list;
  for (const uint32_t slot : slots) list.Append(slot);
  return list;
}

TEST(PostingList, HasWhatWasAppended) {
  const uint32_t largest = PostingList::kNoSlot - 1;
  // Gaps of one to five bytes, at both sides of each limit.
  const std::vector<uint32_t> slots = {0,     1,     128,     256,     383,         512,
                                       16895, 33279, 2130431, 4227583, largest - 1, largest};
  EXPECT_EQ(ContentsOf(ListOf(slots)), slots);
  EXPECT_THAT(ContentsOf({}), testing::IsEmpty());
}

// Dense lists, whose gaps are read four at a time, and sparse ones.
TEST(PostingList, IsRenumbered) {
  std::mt19937 random(5);
  for (const uint32_t max_gap : {2u, 100u, 1000u}) {
    std::vector<uint32_t> slots;
    for (uint32_t slot = 0; slots.size() < 300; slot += 1 + random() % max_gap) {
      slots.push_back(slot);
    }
    // Multiples of three are removed.
    std::vector<uint32_t> new_slots(slots.back() + 1, PostingList::kNoSlot);
    uint32_t next = 0;
    for (uint32_t slot = 0; slot < new_slots.size(); ++slot) {
      if (slot % 3 != 0) new_slots[slot] = next++;
    }
    std::vector<uint32_t> expected;
    for (const uint32_t slot : slots) {
      if (slot % 3 != 0) expected.push_back(new_slots[slot]);
    }
    PostingList list = ListOf(slots);
    list.Renumber(new_slots);
    EXPECT_EQ(ContentsOf(list), expected);
    list.Append(next);
    expected.push_back(next);
    EXPECT_EQ(ContentsOf(list), expected);
  }
}

}  // namespace
}  // namespace msc_vo
