// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/map/id_set.h"

#include <gmock/gmock.h>

#include "msc_vo/map/shared_table.h"

namespace msc_vo {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

using IdTable = SharedTable<int64_t, 4>;

// The values, which are the ids.
std::vector<int64_t> Ids(const IdSet<IdTable>& set) {
  std::vector<int64_t> ids;
  set.VisitAll([&](int64_t value) { ids.push_back(value); });
  return ids;
}

TEST(IdSetTest, VisitsEveryIdOnceInAscendingOrder) {
  IdTable table;
  for (const int64_t id : {7, 8, 70, 71, 134, 135, 1000}) table.Append(id, id);
  IdSet set(table);
  EXPECT_THAT(Ids(set), IsEmpty());
  // First and last id, both sides of word boundaries, and a duplicate.
  for (const int64_t id : {1000, 134, 7, 71, 70, 134}) set.Insert(id);
  EXPECT_THAT(Ids(set), ElementsAre(7, 70, 71, 134, 1000));
}

TEST(IdSetTest, IsEmptyForAnEmptyTable) {
  const IdTable table;
  EXPECT_THAT(Ids(IdSet(table)), IsEmpty());
}

}  // namespace
}  // namespace msc_vo
