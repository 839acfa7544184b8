// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/place_recognition/posting_list.h"

#include <limits>
#include <random>
#include <set>
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
  for (const uint32_t slot : slots) list.Insert(slot);
  return list;
}

TEST(PostingList, IsAscendingInAnyOrderOfInsertion) {
  const uint32_t largest = std::numeric_limits<uint32_t>::max();
  // Gaps of one to five bytes, at both sides of each limit.
  const std::vector<uint32_t> slots = {0,     1,     128,     256,     383,         512,
                                       16895, 33279, 2130431, 4227583, largest - 1, largest};
  EXPECT_EQ(ContentsOf(ListOf(slots)), slots);
  EXPECT_EQ(ContentsOf(ListOf({slots.rbegin(), slots.rend()})), slots);
  EXPECT_THAT(ContentsOf({}), testing::IsEmpty());
}

TEST(PostingList, ForgetsWhatIsRemoved) {
  PostingList list = ListOf({7, 300, 310, 70000});
  list.Remove(300);
  EXPECT_THAT(ContentsOf(list), testing::ElementsAre(7, 310, 70000));
  list.Remove(70000);  // the last one
  list.Insert(311);
  EXPECT_THAT(ContentsOf(list), testing::ElementsAre(7, 310, 311));
  list.Remove(7);
  EXPECT_EQ(list.size(), 2);
  list.Remove(310);
  list.Remove(311);
  EXPECT_EQ(list.size(), 0);
  list.Insert(2);
  EXPECT_THAT(ContentsOf(list), testing::ElementsAre(2));
}

// Dense lists, whose gaps are read four at a time, and sparse ones.
TEST(PostingList, IsASet) {
  std::mt19937 random(5);
  for (const uint32_t range : {40u, 2000u, 100000u}) {
    std::uniform_int_distribution<uint32_t> any(0, range - 1);
    PostingList list;
    std::set<uint32_t> expected;
    for (int i = 0; i < 600; ++i) {
      const uint32_t slot = any(random);
      if (expected.insert(slot).second) {
        list.Insert(slot);
      } else {
        expected.erase(slot);
        list.Remove(slot);
      }
      ASSERT_EQ(list.size(), static_cast<int>(expected.size()));
      ASSERT_THAT(ContentsOf(list), testing::ElementsAreArray(expected));
    }
  }
}

}  // namespace
}  // namespace msc_vo
