// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <typeindex>
#include <unordered_map>
#include <utility>
#include <vector>

#include "msc_vo/checkpoint/checksum.h"

namespace msc_vo {

/// An immutable object in a journal, named by its position.
using ObjectId = uint64_t;
constexpr ObjectId kNoObject = ~ObjectId{0};

/// The immutable objects that successive checkpoints of a run share, such as the frames of its
/// keyframes: each is written once, and checkpoints refer to it. The journal knows an object by its
/// address or by its bytes, and does not keep it alive.
class ObjectJournal {
 public:
  /// Takes bytes that follow those it got before; may throw.
  using Sink = std::function<void(uint64_t offset, std::string_view bytes)>;
  /// What was written so far is of no use, but the objects that had room are in the journal.
  struct NoRoom {};

  ObjectJournal() = default;
  /// A journal whose pending bytes go to `sink` now and then instead of growing.
  explicit ObjectJournal(Sink sink) : sink_(std::move(sink)) {}
  /// A journal read from a file, to be continued.
  explicit ObjectJournal(std::string bytes, Sink sink = nullptr);

  // Writing.

  /// The id of an object that is in the journal; kNoObject if it is not.
  ObjectId Find(const std::shared_ptr<const void>& object) const;
  /// Appends an object in binary form, which refers to the objects `children`.
  ObjectId Append(const std::shared_ptr<const void>& object, const std::string& bytes,
                  const std::vector<ObjectId>& children);
  /// The id of the object with these bytes, which is appended if the journal has none.
  ObjectId AppendContent(const std::string& bytes, const std::vector<ObjectId>& children);
  /// Appending throws NoRoom from now on once objects of `num_bytes` have been appended.
  void SetRoom(uint64_t num_bytes) { end_of_room_ = size() + num_bytes; }
  /// Forgets all objects but those that `roots` refer to, directly or through others.
  void Keep(const std::vector<ObjectId>& roots);
  /// Bytes of the objects that Keep() kept.
  uint64_t num_kept_bytes() const { return num_kept_bytes_; }

  /// Bytes of the journal.
  uint64_t size() const { return num_given_ + pending_.size(); }
  /// Checksum of all of them.
  uint64_t checksum() const { return Checksum(pending_, given_checksum_); }
  /// The bytes that the sink has not got; all without a sink.
  const std::string& pending() const { return pending_; }
  /// Gives them to the sink.
  void Flush();
  /// A checkpoint with the journal as it is now is complete.
  void SetWritten();
  /// Whether there is one, and the bytes of the journal in it.
  bool is_written() const { return is_written_; }
  uint64_t written() const { return num_written_; }
  /// Forgets the objects that were appended since.
  void RollBack();

  // Reading. All throw std::runtime_error if the bytes are not those of a journal.

  /// The object, if it was loaded; null otherwise.
  std::shared_ptr<void> FindLoaded(ObjectId id, const std::type_info& type) const;
  /// The bytes of an object that is to be loaded.
  std::string_view Load(ObjectId id) const;
  void SetLoaded(ObjectId id, const std::shared_ptr<void>& object, const std::type_info& type,
                 const std::vector<ObjectId>& children);
  /// The same for an object that the journal knows by its bytes.
  void SetLoadedContent(ObjectId id, const std::vector<ObjectId>& children);
  /// All objects are loaded: frees the bytes.
  void FinishLoading();

 private:
  struct Object {
    const void* address = nullptr;    // null: it is known by its bytes
    std::weak_ptr<const void> owner;  // expires when the object is destroyed
    uint64_t checksum = 0;            // of the bytes it is known by
    uint64_t size = 0;                // bytes
    std::vector<ObjectId> children;
  };
  struct LoadedObject {
    std::shared_ptr<void> pointer;
    std::type_index type;
  };

  ObjectId AppendBytes(const std::string& bytes);
  // Removes an object; returns the next one.
  std::map<ObjectId, Object>::iterator Forget(std::map<ObjectId, Object>::iterator object);

  std::unordered_map<const void*, ObjectId> ids_;       // by address
  std::unordered_map<uint64_t, ObjectId> content_ids_;  // by checksum
  std::map<ObjectId, Object> objects_;
  uint64_t num_kept_bytes_ = 0;
  uint64_t end_of_room_ = ~uint64_t{0};
  bool is_written_ = false;
  uint64_t num_written_ = 0;
  uint64_t written_checksum_ = kEmptyChecksum;
  Sink sink_;
  uint64_t num_given_ = 0;
  uint64_t given_checksum_ = kEmptyChecksum;
  std::string pending_;
  std::string loaded_bytes_;
  std::unordered_map<ObjectId, LoadedObject> loaded_;
};

}  // namespace msc_vo
