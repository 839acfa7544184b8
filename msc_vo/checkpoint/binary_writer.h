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
#include <type_traits>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "msc_vo/checkpoint/field_count.h"
#include "msc_vo/checkpoint/object_journal.h"

namespace msc_vo {

/// Writes values in binary form, to be read by BinaryReader in the same order.
///
/// A class takes part with one member function that lists its state for both directions:
///
///     template <typename Archive>
///     void Serialize(Archive& archive) { archive(count_, poses_); }
///
/// Plain structs call archive.Fields(*this, ...), which compiles only if no field is missing. What
/// a shared pointer points to must not change any more: it goes to the journal, once however many
/// pointers and archives refer to it.
class BinaryWriter {
 public:
  /// `journal` takes the shared objects and must outlive the writer.
  /// `num_bytes`: memory to begin with.
  explicit BinaryWriter(ObjectJournal* journal, size_t num_bytes = 0) : journal_(journal) {
    bytes_.reserve(num_bytes);
  }

  /// Writes the values one after the other.
  template <typename... Values>
  void operator()(const Values&... values) {
    (Put(values), ...);
  }
  /// Writes all fields of a struct.
  template <typename T, typename... Values>
  void Fields(const T& value, const Values&... fields) {
    CheckFieldCount<sizeof...(fields)>(value);
    (*this)(fields...);
  }
  /// Writes values that have no default; see BinaryReader.
  template <typename T, typename Make>
  void Entries(const std::vector<T>& values, const Make& /*make*/) {
    Put(values);
  }

  const std::string& bytes() const { return bytes_; }
  /// Shared objects that the bytes refer to.
  const std::vector<ObjectId>& objects() const { return objects_; }

 private:
  void PutBytes(const void* data, size_t size);
  void PutSize(size_t size) { Put(static_cast<uint64_t>(size)); }

  template <typename T>
  void Put(const T& value) {
    if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
      PutBytes(&value, sizeof(value));
    } else {
      // Reading needs a function that changes its object; with a writer it does not.
      const_cast<T&>(value).Serialize(*this);
    }
  }
  void Put(const std::string& text) {
    PutSize(text.size());
    PutBytes(text.data(), text.size());
  }
  template <typename T, int rows, int columns, int options>
  void Put(const Eigen::Matrix<T, rows, columns, options>& matrix) {
    PutSize(matrix.rows());
    PutSize(matrix.cols());
    PutBytes(matrix.data(), matrix.size() * sizeof(T));
  }
  void Put(const Eigen::Quaterniond& rotation) { Put(rotation.coeffs()); }
  template <typename T>
  void Put(const std::vector<T>& values) {
    PutSequence(values);
  }
  void Put(const std::vector<bool>& values) {
    PutSize(values.size());
    for (const bool value : values) Put(value);
  }
  template <typename T>
  void Put(const std::deque<T>& values) {
    PutSequence(values);
  }
  template <typename T>
  void Put(const std::set<T>& values) {
    PutSequence(values);
  }
  template <typename Key, typename T>
  void Put(const std::map<Key, T>& values) {
    PutSequence(values);
  }
  template <typename T, size_t size>
  void Put(const std::array<T, size>& values) {
    for (const T& value : values) Put(value);
  }
  template <typename A, typename B>
  void Put(const std::pair<A, B>& value) {
    (*this)(value.first, value.second);
  }
  template <typename T>
  void Put(const std::optional<T>& value) {
    Put(value.has_value());
    if (value) Put(*value);
  }
  template <typename T>
  void Put(const std::shared_ptr<T>& pointer) {
    ObjectId id = pointer ? journal_->Find(pointer.get()) : kNoObject;
    if (pointer && id == kNoObject) {
      BinaryWriter object(journal_);
      object(*pointer);
      id = journal_->Append(pointer, object.bytes(), object.objects());
    }
    if (pointer) objects_.push_back(id);
    Put(id);
  }

  template <typename Sequence>
  void PutSequence(const Sequence& values) {
    PutSize(values.size());
    for (const auto& value : values) Put(value);
  }

  ObjectJournal* journal_;
  std::string bytes_;
  std::vector<ObjectId> objects_;
};

}  // namespace msc_vo
