// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/ros_bag/mcap_file.h"

#include <algorithm>
#include <set>
#include <stdexcept>
#include <utility>

#include <libdeflate.h>

#include "msc_vo/geometry/erase_if.h"
#include "msc_vo/ros_bag/decompression.h"
#include "msc_vo/ros_bag/little_endian_fields.h"
#include "msc_vo/ros_bag/mcap_format.h"

namespace msc_vo {

namespace {

using namespace mcap;

constexpr uint64_t kRecordHeader = 9;    // opcode and length of the content
constexpr uint64_t kMessageHeader = 22;  // channel, number, two times
constexpr size_t kNumUnpacked = 2;

McapMessage ParseMessageHeader(LittleEndianFields fields, int chunk, uint64_t offset) {
  McapMessage message;
  message.channel = fields.Read<uint16_t>();
  fields.Read<uint32_t>();  // its number in the channel
  message.log_time = fields.Read<uint64_t>();
  message.chunk = chunk;
  message.offset = offset;
  return message;
}

}  // namespace

McapFile::McapFile(const std::string& path) : file_(path, std::ios::binary | std::ios::ate) {
  if (!file_) throw std::runtime_error("cannot be opened (check its permissions)");
  size_ = static_cast<uint64_t>(file_.tellg());
  if (ReadBytes(0, std::min<uint64_t>(size_, kMagic.size())) != kMagic) {
    throw std::runtime_error("is no MCAP file of version 0");
  }
  GoThroughFile();
  if (is_cut_off_) ForgetLastIndex();
  ReadUnindexedChunks();
  const auto position = [this](const McapMessage& message) {
    return message.chunk < 0
               ? std::pair(message.offset, uint64_t{0})
               : std::pair(chunks_[static_cast<size_t>(message.chunk)].begin, message.offset);
  };
  std::stable_sort(
      messages_.begin(), messages_.end(),
      [&](const McapMessage& a, const McapMessage& b) { return position(a) < position(b); });
}

void McapFile::GoThroughFile() {
  Record record;
  for (uint64_t at = kMagic.size(); ReadRecord(at, &record); at = record.end()) {
    if (record.opcode == kFooter) return;
    AddRecord(record);
  }
  is_cut_off_ = true;
}

bool McapFile::ReadRecord(uint64_t at, Record* record) {
  if (size_ - at < kRecordHeader) return false;
  const std::string header = ReadBytes(at, kRecordHeader);
  LittleEndianFields fields(header);
  record->opcode = fields.Read<uint8_t>();
  record->begin = at + kRecordHeader;
  record->size = fields.Read<uint64_t>();
  return record->size <= size_ - record->begin;
}

void McapFile::AddRecord(const Record& record) {
  switch (record.opcode) {
    case kSchema:
    case kChannel:
      return AddDefinition(record.opcode, ReadBytes(record.begin, record.size));
    case kMessage: {
      const std::string header =
          ReadBytes(record.begin, std::min<uint64_t>(record.size, kMessageHeader));
      messages_.push_back(
          ParseMessageHeader(LittleEndianFields(header), -1, record.begin - kRecordHeader));
      return;
    }
    case kChunk:
      return AddChunk(record);
    case kMessageIndex:
      return AddIndex(record);
    default:
      return;
  }
}

void McapFile::AddDefinition(uint8_t opcode, std::string_view content) {
  LittleEndianFields fields(content);
  const auto id = fields.Read<uint16_t>();
  if (opcode == kSchema) {
    schemas_[id] = fields.ReadString();
    return;
  }
  McapChannel& channel = channels_[id];
  const auto schema = schemas_.find(fields.Read<uint16_t>());
  if (schema != schemas_.end()) channel.schema = schema->second;
  channel.topic = fields.ReadString();
  channel.encoding = fields.ReadString();
}

void McapFile::AddChunk(const Record& record) {
  constexpr uint64_t kMaxHeader = 256;  // the name of a compression is short
  const std::string header = ReadBytes(record.begin, std::min(record.size, kMaxHeader));
  LittleEndianFields fields(header);
  Chunk chunk;
  fields.Take(2 * sizeof(uint64_t));  // times of the first and last message
  chunk.unpacked_size = fields.Read<uint64_t>();
  chunk.crc = fields.Read<uint32_t>();
  chunk.compression = fields.ReadString();
  chunk.size = fields.Read<uint64_t>();
  chunk.begin = record.begin + header.size() - fields.size();
  if (chunk.size > record.end() - chunk.begin) {
    throw std::runtime_error("a chunk is longer than its record");
  }
  chunks_.push_back(std::move(chunk));
}

void McapFile::AddIndex(const Record& record) {
  if (chunks_.empty()) return;
  chunks_.back().is_indexed = true;
  const std::string content = ReadBytes(record.begin, record.size);
  LittleEndianFields fields(content);
  const auto channel = fields.Read<uint16_t>();
  LittleEndianFields entries(fields.ReadArray());
  while (entries.size() > 0) {
    McapMessage message;
    message.channel = channel;
    message.log_time = entries.Read<uint64_t>();
    message.chunk = static_cast<int>(chunks_.size()) - 1;
    message.offset = entries.Read<uint64_t>();
    messages_.push_back(message);
  }
}

void McapFile::ForgetLastIndex() {
  if (chunks_.empty()) return;
  chunks_.back().is_indexed = false;
  const int last = static_cast<int>(chunks_.size()) - 1;
  EraseIf(&messages_, [&](const McapMessage& m) { return m.chunk == last; });
}

void McapFile::ReadUnindexedChunks() {
  std::set<int> with_unknown_channels;
  for (const McapMessage& message : messages_) {
    if (message.chunk >= 0 && channels_.count(message.channel) == 0) {
      with_unknown_channels.insert(message.chunk);
    }
  }
  for (int i = 0; i < num_chunks(); ++i) {
    const bool is_indexed = chunks_[static_cast<size_t>(i)].is_indexed;
    if (is_indexed && with_unknown_channels.count(i) == 0) continue;
    try {
      GoThroughChunk(i, !is_indexed);
    } catch (const std::runtime_error&) {
      if (++num_damaged_chunks_ == num_chunks()) throw;
    }
  }
}

void McapFile::GoThroughChunk(int chunk, bool with_messages) {
  const std::shared_ptr<const std::string> bytes = Unpack(chunk);
  LittleEndianFields fields(*bytes);
  while (fields.size() > 0) {
    const uint64_t offset = bytes->size() - fields.size();
    const auto opcode = fields.Read<uint8_t>();
    const std::string_view content = fields.Take(fields.Read<uint64_t>());
    if (opcode == kSchema || opcode == kChannel) AddDefinition(opcode, content);
    if (opcode == kMessage && with_messages) {
      messages_.push_back(ParseMessageHeader(LittleEndianFields(content), chunk, offset));
    }
  }
}

std::string McapFile::ReadBytes(uint64_t begin, uint64_t size) {
  if (size > kMaxUnpackedBytes) throw std::runtime_error("a record is larger than 1 GB");
  std::string bytes(size, '\0');
  file_.clear();
  file_.seekg(static_cast<std::streamoff>(begin));
  if (size > 0 && !file_.read(bytes.data(), static_cast<std::streamsize>(size))) {
    throw std::runtime_error("cannot be read");
  }
  return bytes;
}

std::shared_ptr<const std::string> McapFile::Unpack(int index) {
  for (const auto& [chunk, bytes] : unpacked_) {
    if (chunk == index) return bytes;
  }
  const Chunk& chunk = chunks_.at(static_cast<size_t>(index));
  std::string bytes = ReadBytes(chunk.begin, chunk.size);
  const size_t limit = std::min<uint64_t>(chunk.unpacked_size, kMaxUnpackedBytes);
  if (chunk.compression == "zstd") {
    bytes = UnpackZstd(bytes, limit);
  } else if (chunk.compression == "lz4") {
    bytes = UnpackLz4(bytes, limit);
  } else if (!chunk.compression.empty()) {
    throw std::runtime_error("its chunks are compressed with '" + chunk.compression +
                             "', which is neither zstd nor lz4");
  }
  if (bytes.size() != chunk.unpacked_size ||
      (chunk.crc != 0 && libdeflate_crc32(0, bytes.data(), bytes.size()) != chunk.crc)) {
    throw std::runtime_error("a chunk is damaged");
  }
  if (unpacked_.size() == kNumUnpacked) unpacked_.erase(unpacked_.begin());
  unpacked_.emplace_back(index, std::make_shared<const std::string>(std::move(bytes)));
  return unpacked_.back().second;
}

std::string McapFile::Read(const McapMessage& message) {
  if (message.chunk < 0) {
    Record record;
    if (!ReadRecord(message.offset, &record) || record.size < kMessageHeader) {
      throw std::runtime_error("the message is damaged");
    }
    return ReadBytes(record.begin + kMessageHeader, record.size - kMessageHeader);
  }
  const std::shared_ptr<const std::string> chunk = Unpack(message.chunk);
  LittleEndianFields fields(*chunk);
  fields.Take(message.offset);
  const auto opcode = fields.Read<uint8_t>();
  LittleEndianFields content(fields.Take(fields.Read<uint64_t>()));
  const McapMessage read = ParseMessageHeader(content, message.chunk, message.offset);
  if (opcode != kMessage || read.channel != message.channel) {
    throw std::runtime_error("the index does not lead to the message");
  }
  content.Take(kMessageHeader);
  return std::string(content.Take(content.size()));
}

}  // namespace msc_vo
