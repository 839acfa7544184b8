// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace msc_vo {

/// A sorted set of ids of a SharedTable, stored as one bit per id between the table's lowest and
/// highest. Collecting the landmarks of twenty keyframes in order is faster this way than by
/// sorting.
template <typename Table>
class IdSet {
 public:
  explicit IdSet(const Table& table) : table_(table) {
    if (table.empty()) return;
    first_ = table.front().first;
    words_.resize((table.back().first - first_) / kBits + 1);
  }

  /// `id` must be in the table.
  void Insert(int64_t id) {
    const int64_t bit = id - first_;
    words_[bit / kBits] |= uint64_t{1} << (bit % kBits);
  }

  /// Calls visit(value) for the value of each, by ascending id.
  template <typename Visit>
  void VisitAll(const Visit& visit) const {
    typename Table::Cursor cursor(table_);
    for (size_t i = 0; i < words_.size(); ++i) {
      int64_t id = first_ + static_cast<int64_t>(i) * kBits;
      for (uint64_t word = words_[i]; word != 0; word >>= 1, ++id) {
        if (word & 1) visit(*cursor.Find(id));
      }
    }
  }

 private:
  static constexpr int kBits = 64;

  const Table& table_;
  int64_t first_ = 0;
  std::vector<uint64_t> words_;
};

}  // namespace msc_vo
