// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/map/shared_table.h"

#include <map>
#include <random>
#include <set>

#include <gtest/gtest.h>

namespace msc_vo {
namespace {

using Table = SharedTable<int, 4>;

std::map<int64_t, int> Contents(const Table& table) {
  std::map<int64_t, int> contents;
  for (const auto& [id, value] : table) contents[id] = value;
  return contents;
}

// Ids 10, 20, ..., 180: four full blocks and a partial one.
Table MakeTable() {
  Table table;
  for (int i = 1; i <= 18; ++i) table.Append(10 * i, i);
  return table;
}

TEST(SharedTableTest, FindsIds) {
  const Table table = MakeTable();
  EXPECT_EQ(table.size(), 18u);
  for (int i = 1; i <= 18; ++i) {
    ASSERT_NE(table.Find(10 * i), nullptr) << i;
    EXPECT_EQ(*table.Find(10 * i), i);
    EXPECT_EQ(table.Find(10 * i + 1), nullptr) << i;
    EXPECT_EQ(table.FindUpTo(10 * i + 9)->first, 10 * i);
  }
  EXPECT_EQ(table.Find(9), nullptr);
  EXPECT_EQ(table.FindUpTo(9), nullptr);
  EXPECT_EQ(table.front().first, 10);
  EXPECT_EQ(table.back().first, 180);
}

TEST(SharedTableTest, FindsAscendingIdsByACursor) {
  const Table table = MakeTable();
  Table::Cursor cursor(table);
  for (int64_t id = -3; id < 200; id += 1) {
    const int* value = cursor.Find(id);
    ASSERT_EQ(value, table.Find(id)) << id;
    EXPECT_EQ(cursor.Find(id), value) << id;
  }
  const Table empty;
  EXPECT_EQ(Table::Cursor(empty).Find(3), nullptr);
}

TEST(SharedTableTest, FindsNothingIfEmpty) {
  Table table;
  EXPECT_TRUE(table.empty());
  EXPECT_EQ(table.size(), 0u);
  EXPECT_EQ(table.Find(1), nullptr);
  EXPECT_EQ(table.FindUpTo(1), nullptr);
  EXPECT_EQ(table.FindToChange(1), nullptr);
  table.Erase(1);
  EXPECT_TRUE(Contents(table).empty());
}

TEST(SharedTableTest, CopiesOnlyBlocksThatChange) {
  Table table = MakeTable();
  const Table shared = table.Share();
  EXPECT_EQ(shared.Find(50), table.Find(50));
  *table.FindToChange(60) = -6;
  EXPECT_NE(shared.Find(50), table.Find(50));  // same block as 60
  EXPECT_EQ(shared.Find(90), table.Find(90));  // next block
  EXPECT_EQ(*shared.Find(60), 6);
  EXPECT_EQ(*table.Find(60), -6);
}

TEST(SharedTableTest, ChangesUnsharedBlocksInPlace) {
  Table table = MakeTable();
  { const Table shared = table.Share(); }
  *table.FindToChange(60) = -6;
  const int* place = table.Find(50);
  *table.FindToChange(50) = -5;
  EXPECT_EQ(table.Find(50), place);
}

// Compares table and snapshots with a std::map and copies of it.
TEST(SharedTableTest, MatchesStdMapUnderRandomChanges) {
  std::mt19937 random(5);
  Table table;
  std::map<int64_t, int> expected;
  std::vector<Table> snapshots;
  std::vector<std::map<int64_t, int>> copies;
  for (int64_t id = 0; id < 3000; ++id) {
    table.Append(id, static_cast<int>(id));
    expected[id] = static_cast<int>(id);
    const int64_t chosen = random() % (id + 1);
    if (int* value = table.FindToChange(chosen)) {
      *value += 1;
      expected.at(chosen) += 1;
    }
    for (int i = random() % 3; i > 0; --i) {
      const int64_t erased = random() % (id + 1);
      table.Erase(erased);
      expected.erase(erased);
    }
    if (id % 300 != 0) continue;
    snapshots.push_back(table.Share());
    copies.push_back(expected);
  }
  EXPECT_EQ(Contents(table), expected);
  EXPECT_EQ(table.size(), expected.size());
  for (int64_t id = 0; id < 3000; ++id) {
    EXPECT_EQ(table.Find(id) != nullptr, expected.count(id) > 0) << id;
  }
  for (size_t i = 0; i < snapshots.size(); ++i) EXPECT_EQ(Contents(snapshots[i]), copies[i]) << i;
}

TEST(SharedTableTest, ChangesInASnapshotDoNotAffectTheTable) {
  Table table = MakeTable();
  Table shared = table.Share();
  shared.Erase(10);
  shared.Append(190, 19);
  EXPECT_EQ(Contents(table), Contents(MakeTable()));
  EXPECT_EQ(shared.size(), 18u);
}

// Against a comparison of all values, over random changes of all kinds.
TEST(SharedTableTest, VisitsChanges) {
  std::mt19937 random(5);
  Table table;
  int64_t next = 0;
  for (int round = 0; round < 200; ++round) {
    const Table before = table.Share();
    for (int i = static_cast<int>(random() % 8); i > 0; --i) {
      const int64_t id = next > 0 ? static_cast<int64_t>(random() % next) : 0;
      if (random() % 2 == 0) table.Append(next++, 0);
      if (random() % 2 == 0) table.Erase(id);
      if (int* value = table.FindToChange(id)) ++*value;
    }
    std::set<int64_t> changed, erased;
    table.VisitChanges(
        before, [&](const auto& entry) { changed.insert(entry.first); },
        [&](int64_t id) { erased.insert(id); });
    size_t num_unchanged = 0;
    for (const auto& [id, value] : table) {
      const int* const was = before.Find(id);
      const bool is_changed = was == nullptr || *was != value;
      EXPECT_GE(changed.count(id), is_changed ? 1u : 0u);
      num_unchanged += 1 - changed.count(id);
    }
    EXPECT_EQ(num_unchanged + changed.size(), table.size());
    std::set<int64_t> missing;
    for (const auto& [id, value] : before) {
      if (table.Find(id) == nullptr) missing.insert(id);
    }
    EXPECT_EQ(erased, missing);
    EXPECT_GE(num_unchanged, round > 100 ? 1u : 0u);
  }
}

}  // namespace
}  // namespace msc_vo
