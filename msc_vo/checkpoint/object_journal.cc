// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/checkpoint/object_journal.h"

#include <cstring>
#include <set>
#include <stdexcept>
#include <utility>

namespace msc_vo {

namespace {

// An object is its size and its bytes, padded so that checksums can be continued.
constexpr uint64_t kAlignment = 8;

uint64_t PaddedSize(uint64_t size) { return (size + kAlignment - 1) / kAlignment * kAlignment; }

[[noreturn]] void Fail() { throw std::runtime_error("its objects are not those of a checkpoint"); }

}  // namespace

ObjectJournal::ObjectJournal(std::string bytes, Sink sink)
    : is_written_(true),
      num_written_(bytes.size()),
      written_checksum_(Checksum(bytes)),
      sink_(std::move(sink)),
      num_given_(bytes.size()),
      given_checksum_(written_checksum_),
      loaded_bytes_(std::move(bytes)) {}

ObjectId ObjectJournal::Find(const std::shared_ptr<const void>& object) const {
  const auto id = ids_.find(object.get());
  if (id == ids_.end()) return kNoObject;
  // The object may be at an address where another one was.
  const std::weak_ptr<const void>& known = objects_.at(id->second).owner;
  return known.owner_before(object) || object.owner_before(known) ? kNoObject : id->second;
}

ObjectId ObjectJournal::Append(const std::shared_ptr<const void>& object, const std::string& bytes,
                               const std::vector<ObjectId>& children) {
  const ObjectId id = AppendBytes(bytes);
  ids_[object.get()] = id;
  objects_[id] = {object.get(), object, 0, size() - id, children};
  return id;
}

ObjectId ObjectJournal::AppendContent(const std::string& bytes,
                                      const std::vector<ObjectId>& children) {
  const uint64_t checksum = Checksum(bytes);
  const auto known = content_ids_.find(checksum);
  if (known != content_ids_.end()) return known->second;
  const ObjectId id = AppendBytes(bytes);
  content_ids_[checksum] = id;
  objects_[id] = {nullptr, {}, checksum, size() - id, children};
  return id;
}

ObjectId ObjectJournal::AppendBytes(const std::string& bytes) {
  if (size() >= end_of_room_) throw NoRoom();
  constexpr size_t kMaxPending = size_t{1} << 18;
  if (sink_ && pending_.size() > kMaxPending) Flush();
  const ObjectId id = size();
  const uint64_t num_bytes = bytes.size();
  pending_.append(reinterpret_cast<const char*>(&num_bytes), sizeof(num_bytes));
  pending_ += bytes;
  pending_.append(PaddedSize(num_bytes) - num_bytes, '\0');
  return id;
}

std::map<ObjectId, ObjectJournal::Object>::iterator ObjectJournal::Forget(
    std::map<ObjectId, Object>::iterator object) {
  const auto& [id, known] = *object;
  if (known.address == nullptr) content_ids_.erase(known.checksum);
  const auto at_address = ids_.find(known.address);
  if (at_address != ids_.end() && at_address->second == id) ids_.erase(at_address);
  return objects_.erase(object);
}

void ObjectJournal::Keep(const std::vector<ObjectId>& roots) {
  std::set<ObjectId> kept;
  std::vector<ObjectId> open = roots;
  while (!open.empty()) {
    const ObjectId id = open.back();
    open.pop_back();
    if (!kept.insert(id).second) continue;
    const std::vector<ObjectId>& children = objects_.at(id).children;
    open.insert(open.end(), children.begin(), children.end());
  }
  num_kept_bytes_ = 0;
  for (auto object = objects_.begin(); object != objects_.end();) {
    if (kept.count(object->first) > 0) {
      num_kept_bytes_ += object->second.size;
      ++object;
    } else {
      object = Forget(object);
    }
  }
}

void ObjectJournal::Flush() {
  sink_(num_given_, pending_);
  given_checksum_ = checksum();
  num_given_ = size();
  pending_.clear();
}

void ObjectJournal::SetWritten() {
  is_written_ = true;
  num_written_ = size();
  written_checksum_ = checksum();
}

void ObjectJournal::RollBack() {
  for (auto object = objects_.lower_bound(num_written_); object != objects_.end();) {
    object = Forget(object);
  }
  pending_.clear();
  num_given_ = num_written_;
  given_checksum_ = written_checksum_;
}

std::shared_ptr<void> ObjectJournal::FindLoaded(ObjectId id, const std::type_info& type) const {
  const auto object = loaded_.find(id);
  if (object == loaded_.end()) return nullptr;
  if (object->second.type != std::type_index(type)) Fail();
  return object->second.pointer;
}

std::string_view ObjectJournal::Load(ObjectId id) const {
  const std::string_view bytes = loaded_bytes_;
  uint64_t size = 0;
  if (id % kAlignment != 0 || id >= bytes.size() || bytes.size() - id < sizeof(size)) Fail();
  std::memcpy(&size, bytes.data() + id, sizeof(size));
  const std::string_view rest = bytes.substr(id + sizeof(size));
  if (size > rest.size()) Fail();
  return rest.substr(0, size);
}

void ObjectJournal::SetLoaded(ObjectId id, const std::shared_ptr<void>& object,
                              const std::type_info& type, const std::vector<ObjectId>& children) {
  loaded_.insert({id, {object, std::type_index(type)}});
  ids_[object.get()] = id;
  objects_[id] = {object.get(), object, 0, sizeof(uint64_t) + PaddedSize(Load(id).size()),
                  children};
}

void ObjectJournal::SetLoadedContent(ObjectId id, const std::vector<ObjectId>& children) {
  const std::string_view bytes = Load(id);
  const uint64_t checksum = Checksum(bytes);
  content_ids_[checksum] = id;
  objects_[id] = {nullptr, {}, checksum, sizeof(uint64_t) + PaddedSize(bytes.size()), children};
}

void ObjectJournal::FinishLoading() {
  std::string().swap(loaded_bytes_);
  loaded_.clear();
}

}  // namespace msc_vo
