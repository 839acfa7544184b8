// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <typeinfo>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "msc_vo/checkpoint/fields.h"
#include "msc_vo/checkpoint/object_journal.h"

namespace msc_vo {

/// Reads what BinaryWriter wrote, in the same order. Pointers that shared an object share it again.
/// Every function throws std::runtime_error if the bytes are not those of such values; the objects
/// are then valid, but partly read.
class BinaryReader {
 public:
  /// `bytes` and `journal`, which has the shared objects, must outlive the reader.
  BinaryReader(std::string_view bytes, ObjectJournal* journal)
      : BinaryReader(bytes, kNoObject, journal) {}

  /// Reads the values one after the other.
  template <typename... Values>
  void operator()(Values&... values) {
    (Get(values), ...);
  }
  /// Reads what BinaryWriter::Fields() wrote.
  template <typename T, typename... Values>
  void Fields(const T& value, Values&... fields) {
    CheckFieldCount<sizeof...(fields)>(value);
    (*this)(fields...);
  }
  /// Reads values that have no default: they are read into results of make().
  template <typename T, typename Make>
  void Entries(std::vector<T>& values, const Make& make) {
    values.clear();
    for (size_t i = GetSize(); i > 0; --i) {
      values.push_back(make());
      Get(values.back());
    }
  }

  /// Reads values in blocks; see BinaryWriter.
  template <typename T>
  void Blocks(std::vector<T>& values) {
    values.clear();
    uint64_t size = 0;
    Get(size);
    while (values.size() < size) {
      ObjectId id = kNoObject;
      Get(id);
      if (id >= id_) Fail();
      BinaryReader block(journal_->Load(id), id, journal_);
      do {
        block.Get(values.emplace_back());
      } while (!block.bytes_.empty());
      journal_->SetLoadedContent(id, block.objects());
      objects_.push_back(id);
    }
    if (values.size() > size) Fail();
  }

  /// Throws std::runtime_error if bytes are left.
  void Finish() const;
  /// Shared objects that the bytes refer to.
  const std::vector<ObjectId>& objects() const { return objects_; }

 private:
  // Reads object `id`, which can only refer to older ones.
  BinaryReader(std::string_view bytes, ObjectId id, ObjectJournal* journal)
      : bytes_(bytes), id_(id), journal_(journal) {}

  void GetBytes(void* data, size_t size);
  // A number of elements, each of which takes at least one byte.
  size_t GetSize();
  [[noreturn]] static void Fail();

  template <typename T>
  void Get(T& value) {
    if constexpr (std::is_same_v<T, bool>) {
      uint8_t byte = 0;
      Get(byte);
      if (byte > 1) Fail();
      value = byte != 0;
    } else if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
      GetBytes(&value, sizeof(value));
    } else if constexpr (kIsPlainStruct<T, BinaryReader>) {
      std::apply(*this, TieFields(value));
    } else {
      value.Serialize(*this);
    }
  }
  void Get(std::string& text) {
    text.resize(GetSize());
    GetBytes(text.data(), text.size());
  }
  template <typename T, int rows, int columns, int options>
  void Get(Eigen::Matrix<T, rows, columns, options>& matrix) {
    const size_t num_rows = rows == Eigen::Dynamic ? GetSize() : static_cast<size_t>(rows);
    const size_t num_columns = columns == Eigen::Dynamic ? GetSize() : static_cast<size_t>(columns);
    if (num_columns > 0 && num_rows > bytes_.size() / num_columns / sizeof(T)) Fail();
    matrix.resize(static_cast<Eigen::Index>(num_rows), static_cast<Eigen::Index>(num_columns));
    GetBytes(matrix.data(), matrix.size() * sizeof(T));
  }
  void Get(Eigen::Quaterniond& rotation) { Get(rotation.coeffs()); }
  template <typename T>
  void Get(std::vector<T>& values) {
    if constexpr (std::is_arithmetic_v<T>) {
      const size_t size = GetSize();
      if (size > bytes_.size() / sizeof(T)) Fail();
      values.resize(size);
      GetBytes(values.data(), size * sizeof(T));
    } else {
      GetSequence(values);
    }
    values.shrink_to_fit();
  }
  void Get(std::vector<bool>& values) {
    values.resize(GetSize());
    for (std::vector<bool>::reference value : values) {
      bool stored = false;
      Get(stored);
      value = stored;
    }
  }
  template <typename T>
  void Get(std::deque<T>& values) {
    GetSequence(values);
  }
  template <typename T>
  void Get(std::set<T>& values) {
    values.clear();
    for (size_t i = GetSize(); i > 0; --i) {
      T value{};
      Get(value);
      values.insert(values.end(), value);
    }
  }
  template <typename Key, typename T>
  void Get(std::map<Key, T>& values) {
    values.clear();
    for (size_t i = GetSize(); i > 0; --i) {
      Key key{};
      Get(key);
      Get(values[key]);
    }
  }
  template <typename T, size_t size>
  void Get(std::array<T, size>& values) {
    if constexpr (std::is_arithmetic_v<T> && !std::is_same_v<T, bool>) {
      GetBytes(values.data(), sizeof(values));
    } else {
      for (T& value : values) Get(value);
    }
  }
  template <typename A, typename B>
  void Get(std::pair<A, B>& value) {
    (*this)(value.first, value.second);
  }
  template <typename T>
  void Get(std::optional<T>& value) {
    bool has_value = false;
    Get(has_value);
    if (!has_value) return value.reset();
    T stored{};  // read in place after emplace(), GCC 14 takes it for uninitialised
    Get(stored);
    value = std::move(stored);
  }
  template <typename T>
  void Get(std::shared_ptr<T>& pointer) {
    ObjectId id = kNoObject;
    Get(id);
    pointer.reset();
    if (id == kNoObject) return;
    if (id >= id_) Fail();
    using Object = std::remove_const_t<T>;
    std::shared_ptr<void> known = journal_->FindLoaded(id, typeid(Object));
    if (!known) {
      auto object = std::make_shared<Object>();
      BinaryReader reader(journal_->Load(id), id, journal_);
      reader(*object);
      reader.Finish();
      journal_->SetLoaded(id, object, typeid(Object), reader.objects());
      known = object;
    }
    pointer = std::static_pointer_cast<Object>(known);
    objects_.push_back(id);
  }

  template <typename Sequence>
  void GetSequence(Sequence& values) {
    values.clear();
    // Grows with the bytes that are read, so that a corrupt size cannot allocate memory.
    for (size_t i = GetSize(); i > 0; --i) Get(values.emplace_back());
  }

  std::string_view bytes_;
  ObjectId id_;  // kNoObject: no object
  ObjectJournal* journal_;
  std::vector<ObjectId> objects_;
};

}  // namespace msc_vo
