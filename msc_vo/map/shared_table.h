// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <memory>
#include <set>
#include <utility>
#include <vector>

namespace msc_vo {

/// A copy-on-write table of values by ascending id, in blocks of at most `kBlockSize`: the leaves
/// of a B+ tree of height one. Two tables share a block until one of them changes it and copies it
/// first. A snapshot costs one pointer per block, and later a copy of each block that changes.
///
/// Pointers and references to values are valid until the next change of the table.
template <typename T, int kBlockSize>
class SharedTable {
 public:
  using Entry = std::pair<int64_t, T>;

 private:
  using Entries = std::vector<Entry>;
  struct Block {
    int64_t first = 0;    // id of the first entry, so that searches stay in this vector
    bool shared = false;  // possibly with another table: must be copied before a write
    std::shared_ptr<Entries> entries;  // never empty

    template <typename Archive>
    void Serialize(Archive& archive) {
      archive(first, entries);
      shared = true;  // with the archive
    }
  };

 public:
  /// Iterates over the entries by ascending id.
  class Iterator {
   public:
    Iterator(const std::vector<Block>& blocks, size_t block) : blocks_(&blocks), block_(block) {}

    const Entry& operator*() const { return (*(*blocks_)[block_].entries)[entry_]; }
    const Entry* operator->() const { return &**this; }
    Iterator& operator++() {
      if (++entry_ == (*blocks_)[block_].entries->size()) {
        ++block_;
        entry_ = 0;
      }
      return *this;
    }
    bool operator!=(const Iterator& other) const {
      return block_ != other.block_ || entry_ != other.entry_;
    }

   private:
    const std::vector<Block>* blocks_;
    size_t block_;
    size_t entry_ = 0;
  };

  /// Finds values by ascending id: each search goes on where the last one ended.
  class Cursor {
   public:
    explicit Cursor(const SharedTable& table) : blocks_(table.blocks_) {}

    /// Returns nullptr if there is none. `id` must not be lower than that of the last search.
    const T* Find(int64_t id) {
      while (block_ + 1 < blocks_.size() && blocks_[block_ + 1].first <= id) {
        ++block_;
        entry_ = 0;
      }
      if (block_ == blocks_.size()) return nullptr;
      const Entries& entries = *blocks_[block_].entries;
      while (entry_ < entries.size() && entries[entry_].first < id) ++entry_;
      const bool found = entry_ < entries.size() && entries[entry_].first == id;
      return found ? &entries[entry_].second : nullptr;
    }

   private:
    const std::vector<Block>& blocks_;
    size_t block_ = 0;
    size_t entry_ = 0;
  };

  SharedTable() = default;
  SharedTable(SharedTable&&) noexcept = default;
  SharedTable& operator=(SharedTable&&) noexcept = default;
  /// Copies are made by Share(), which marks the shared blocks.
  SharedTable(const SharedTable&) = delete;
  SharedTable& operator=(const SharedTable&) = delete;

  Iterator begin() const { return {blocks_, 0}; }
  Iterator end() const { return {blocks_, blocks_.size()}; }
  bool empty() const { return blocks_.empty(); }
  size_t size() const {
    size_t size = 0;
    for (const Block& block : blocks_) size += block.entries->size();
    return size;
  }
  /// The entries with the lowest and the highest id; the table must not be empty.
  const Entry& front() const { return blocks_.front().entries->front(); }
  const Entry& back() const { return blocks_.back().entries->back(); }

  /// The last entry with an id of at most `id`; nullptr if there is none.
  const Entry* FindUpTo(int64_t id) const {
    if (blocks_.empty() || id < blocks_.front().first) return nullptr;
    const Entries& entries = *blocks_[BlockOf(id)].entries;
    return &*std::prev(
        std::upper_bound(entries.begin(), entries.end(), id,
                         [](int64_t value, const Entry& entry) { return value < entry.first; }));
  }
  /// Returns nullptr if there is none.
  const T* Find(int64_t id) const {
    const Entry* entry = FindUpTo(id);
    return entry != nullptr && entry->first == id ? &entry->second : nullptr;
  }
  /// Like Find(), for writing: copies the block if it is shared.
  T* FindToChange(int64_t id) {
    const Entry* entry = FindUpTo(id);
    if (entry == nullptr || entry->first != id) return nullptr;
    const size_t block = BlockOf(id);
    const size_t place = entry - blocks_[block].entries->data();
    return &(*ToChange(block))[place].second;
  }

  /// `id` must be higher than all ids added before.
  void Append(int64_t id, T value) {
    if (blocks_.empty() || blocks_.back().entries->size() == kBlockSize) {
      blocks_.push_back({id, false, std::make_shared<Entries>()});
    }
    ToChange(blocks_.size() - 1)->emplace_back(id, std::move(value));
  }

  /// No effect if there is none. Adjacent half-empty blocks are joined, which bounds their number.
  void Erase(int64_t id) {
    if (Find(id) == nullptr) return;
    const size_t block = BlockOf(id);
    if (blocks_[block].entries->size() == 1) {
      blocks_.erase(blocks_.begin() + block);
      return;
    }
    Entries* entries = ToChange(block);
    entries->erase(LowerBound(entries, id));
    blocks_[block].first = entries->front().first;
    if (!JoinWithNext(block) && block > 0) JoinWithNext(block - 1);
  }

  /// Adds copies of the entries of `other`, whose ids must differ from those of this table.
  void Merge(const SharedTable& other) {
    SharedTable merged;
    Iterator own = begin();
    for (const Entry& entry : other) {
      for (; own != end() && own->first < entry.first; ++own) {
        merged.Append(own->first, own->second);
      }
      merged.Append(entry.first, entry.second);
    }
    for (; own != end(); ++own) merged.Append(own->first, own->second);
    *this = std::move(merged);
  }

  /// Returns a table with the same values. Either may change afterwards without affecting the
  /// other; each table may be used by one thread at a time.
  SharedTable Share() {
    for (Block& block : blocks_) block.shared = true;
    SharedTable copy;
    copy.blocks_ = blocks_;
    return copy;
  }

  /// Calls changed(entry) for each entry that may differ from that of `before`, ascending: those in
  /// blocks that the tables do not share; and erased(id) for each id of `before` that is missing.
  template <typename Changed, typename Erased>
  void VisitChanges(const SharedTable& before, const Changed& changed, const Erased& erased) const {
    std::set<const Entries*> own, old;
    for (const Block& block : blocks_) own.insert(block.entries.get());
    for (const Block& block : before.blocks_) old.insert(block.entries.get());
    for (const Block& block : blocks_) {
      if (old.count(block.entries.get()) > 0) continue;
      for (const Entry& entry : *block.entries) changed(entry);
    }
    for (const Block& block : before.blocks_) {
      if (own.count(block.entries.get()) > 0) continue;
      for (const Entry& entry : *block.entries) {
        if (Find(entry.first) == nullptr) erased(entry.first);
      }
    }
  }

  /// Lists the state for a checkpoint. Its blocks count as shared afterwards.
  template <typename Archive>
  void Serialize(Archive& archive) {
    archive(blocks_);
  }

 private:
  static typename Entries::iterator LowerBound(Entries* entries, int64_t id) {
    return std::lower_bound(entries->begin(), entries->end(), id,
                            [](const Entry& entry, int64_t value) { return entry.first < value; });
  }

  // Index of the last block that begins at or before `id`. `id` must not precede the first block.
  size_t BlockOf(int64_t id) const {
    const auto next =
        std::upper_bound(blocks_.begin(), blocks_.end(), id,
                         [](int64_t value, const Block& block) { return value < block.first; });
    return next - blocks_.begin() - 1;
  }

  Entries* ToChange(size_t index) {
    Block& block = blocks_[index];
    if (block.shared) block.entries = std::make_shared<Entries>(*block.entries);
    block.shared = false;
    return block.entries.get();
  }

  bool JoinWithNext(size_t index) {
    if (index + 1 == blocks_.size()) return false;
    const Entries& next = *blocks_[index + 1].entries;
    if (2 * (blocks_[index].entries->size() + next.size()) > kBlockSize) return false;
    Entries* entries = ToChange(index);
    entries->insert(entries->end(), next.begin(), next.end());
    blocks_.erase(blocks_.begin() + index + 1);
    return true;
  }

  std::vector<Block> blocks_;
};

}  // namespace msc_vo
