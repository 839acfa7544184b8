// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "msc_vo/checkpoint/fields.h"
#include "msc_vo/checkpoint/object_journal.h"

namespace msc_vo {

/// Writes values in binary form, to be read by BinaryReader in the same order.
///
/// A class takes part with one member function that lists its state for both directions:
///
///     template <typename Archive>
///     void Serialize(Archive& archive) { archive(count_, poses_); }
///
/// A plain struct (an aggregate) needs none: all its fields are written in the order in which they
/// are declared. What a shared pointer points to must not change any more: it goes to the journal,
/// once however many pointers and archives refer to it.
class BinaryWriter {
 public:
  /// Takes bytes that follow those it got before; may throw.
  using Sink = std::function<void(std::string_view bytes)>;

  /// `journal` takes the shared objects and must outlive the writer. The bytes go to `sink` in
  /// parts whose sizes are multiples of eight, the last one by Flush(); without it, they are kept.
  explicit BinaryWriter(ObjectJournal* journal, Sink sink = nullptr)
      : journal_(journal), sink_(std::move(sink)) {}

  /// Writes the values one after the other.
  template <typename... Values>
  void operator()(const Values&... values) {
    (Put(values), ...);
  }
  /// Writes all fields of a struct that is no aggregate, or whose fields NumFields() cannot count;
  /// compiles only if none is missing.
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

  /// Writes values in blocks, which the journal has as objects, so that a block whose values have
  /// not changed is not written again.
  template <typename T>
  void Blocks(const std::vector<T>& values) {
    PutSize(values.size());
    for (size_t i = 0; i < values.size(); i += kBlockSize) {
      BinaryWriter block(journal_);
      for (size_t j = i; j < std::min(i + kBlockSize, values.size()); ++j) block(values[j]);
      PutObject(journal_->AppendContent(block.bytes(), block.objects()));
    }
  }

  /// The bytes so far that no sink has got.
  const std::string& bytes() {
    Collect();
    return bytes_;
  }
  /// Gives the rest of the bytes to the sink.
  void Flush() {
    sink_(bytes());
    bytes_.clear();
  }
  /// Shared objects that the bytes refer to.
  const std::vector<ObjectId>& objects() const { return objects_; }

  /// Values in a block of Blocks().
  static constexpr size_t kBlockSize = 64;

 private:
  void PutBytes(const void* data, size_t size) {
    if (size > recent_.size() - num_recent_) return PutManyBytes(data, size);
    if (size > 0) std::memcpy(recent_.data() + num_recent_, data, size);
    num_recent_ += size;
  }
  void PutManyBytes(const void* data, size_t size);
  // Moves the recent bytes to the others.
  void Collect();
  void PutObject(ObjectId id) {
    objects_.push_back(id);
    Put(id);
  }
  void PutSize(size_t size) { Put(static_cast<uint64_t>(size)); }

  template <typename T>
  void Put(const T& value) {
    if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
      PutBytes(&value, sizeof(value));
    } else if constexpr (kIsPlainStruct<T, BinaryWriter>) {
      std::apply(*this, TieFields(value));
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
    if constexpr (rows == Eigen::Dynamic) PutSize(matrix.rows());
    if constexpr (columns == Eigen::Dynamic) PutSize(matrix.cols());
    PutBytes(matrix.data(), matrix.size() * sizeof(T));
  }
  void Put(const Eigen::Quaterniond& rotation) { Put(rotation.coeffs()); }
  template <typename T>
  void Put(const std::vector<T>& values) {
    if constexpr (std::is_arithmetic_v<T>) {
      PutSize(values.size());
      PutBytes(values.data(), values.size() * sizeof(T));
    } else {
      PutSequence(values);
    }
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
    if constexpr (std::is_arithmetic_v<T>) {
      PutBytes(values.data(), sizeof(values));
    } else {
      for (const T& value : values) Put(value);
    }
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
    if (!pointer) return Put(kNoObject);
    ObjectId id = journal_->Find(pointer);
    if (id == kNoObject) {
      BinaryWriter object(journal_);
      object(*pointer);
      id = journal_->Append(pointer, object.bytes(), object.objects());
    }
    PutObject(id);
  }

  template <typename Sequence>
  void PutSequence(const Sequence& values) {
    PutSize(values.size());
    for (const auto& value : values) Put(value);
  }

  ObjectJournal* journal_;
  Sink sink_;
  std::array<char, 4096> recent_;  // copied to without a call
  size_t num_recent_ = 0;
  std::string bytes_;
  std::vector<ObjectId> objects_;
};

}  // namespace msc_vo
