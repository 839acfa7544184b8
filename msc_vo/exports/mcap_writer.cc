// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/exports/mcap_writer.h"

#include <algorithm>
#include <stdexcept>

#include <libdeflate.h>
#include <zstd.h>

#include "msc_vo/exports/little_endian_bytes.h"
#include "msc_vo/ros_bag/mcap_format.h"
#include "msc_vo/version.h"

namespace msc_vo {

namespace {

using namespace mcap;

constexpr size_t kChunkBytes = 768 * 1024;  // as of rosbag2
constexpr int kCompressionLevel = 3;        // the default of zstd

// Adds a text or an array with its length in front.
LittleEndianBytes& AddText(std::string_view text, LittleEndianBytes* bytes) {
  return bytes->Add(static_cast<uint32_t>(text.size())).Append(text);
}

std::string Record(Opcode opcode, const LittleEndianBytes& content) {
  return LittleEndianBytes()
      .Add(static_cast<uint8_t>(opcode))
      .Add(static_cast<uint64_t>(content.bytes().size()))
      .Append(content.bytes())
      .bytes();
}

uint32_t Checksum(std::string_view bytes) {
  return libdeflate_crc32(0, bytes.data(), bytes.size());
}

std::string Pack(const std::string& bytes) {
  std::string packed(ZSTD_compressBound(bytes.size()), '\0');
  const size_t size =
      ZSTD_compress(packed.data(), packed.size(), bytes.data(), bytes.size(), kCompressionLevel);
  if (ZSTD_isError(size)) throw std::runtime_error("zstd cannot compress a chunk");
  packed.resize(size);
  return packed;
}

}  // namespace

void McapWriter::TimeRange::Extend(uint64_t time, bool is_first) {
  first = is_first ? time : std::min(first, time);
  last = is_first ? time : std::max(last, time);
}

McapWriter::McapWriter(const std::string& path) : file_(path, std::string(kMagic)) {
  size_ = kMagic.size();
  LittleEndianBytes header;
  AddText("ros2", &header);
  AddText(std::string("msc_vo ") + kVersion, &header);
  Append(Record(kHeader, header));
}

void McapWriter::Append(const std::string& bytes) {
  file_.Append(bytes);
  size_ += bytes.size();
}

uint16_t McapWriter::AddChannel(const std::string& topic, const McapSchema& schema) {
  const auto [known, is_new] =
      schemas_.try_emplace(schema.name, static_cast<uint16_t>(schemas_.size() + 1));
  if (is_new) {
    LittleEndianBytes content;
    content.Add(known->second);
    AddText(schema.name, &content);
    AddText("ros2msg", &content);
    AddText(schema.definition, &content);
    schema_records_ += Record(kSchema, content);
    chunk_ += Record(kSchema, content);
  }
  const auto channel = static_cast<uint16_t>(num_messages_.size() + 1);
  num_messages_[channel] = 0;
  LittleEndianBytes metadata;  // rosbag2 expects the key; empty: the defaults
  AddText("offered_qos_profiles", &metadata);
  AddText("", &metadata);
  LittleEndianBytes content;
  content.Add(channel).Add(known->second);
  AddText(topic, &content);
  AddText("cdr", &content);
  AddText(metadata.bytes(), &content);
  channel_records_ += Record(kChannel, content);
  chunk_ += Record(kChannel, content);
  return channel;
}

void McapWriter::Write(uint16_t channel, uint64_t nanoseconds, std::string_view message) {
  const bool is_first = num_chunks_ == 0 && index_.empty();
  times_.Extend(nanoseconds, is_first);
  chunk_times_.Extend(nanoseconds, index_.empty());
  index_[channel].emplace_back(nanoseconds, chunk_.size());
  uint32_t& number = num_messages_.at(channel);
  chunk_ += Record(kMessage, LittleEndianBytes()
                                 .Add(channel)
                                 .Add(number)
                                 .Add(nanoseconds)
                                 .Add(nanoseconds)
                                 .Append(message));
  ++number;
  if (chunk_.size() >= kChunkBytes) WriteChunk();
}

void McapWriter::WriteChunk() {
  const std::string packed = Pack(chunk_);
  LittleEndianBytes chunk;
  chunk.Add(chunk_times_.first).Add(chunk_times_.last).Add(static_cast<uint64_t>(chunk_.size()));
  chunk.Add(Checksum(chunk_));
  AddText("zstd", &chunk);
  chunk.Add(static_cast<uint64_t>(packed.size())).Append(packed);
  const std::string chunk_record = Record(kChunk, chunk);
  const uint64_t begin = size_;
  Append(chunk_record);

  std::string indices;
  LittleEndianBytes offsets;  // of the index of each channel
  for (const auto& [channel, messages] : index_) {
    offsets.Add(channel).Add(static_cast<uint64_t>(size_ + indices.size()));
    LittleEndianBytes entries;
    for (const auto& [time, position] : messages) entries.Add(time).Add(position);
    LittleEndianBytes content;
    content.Add(channel);
    AddText(entries.bytes(), &content);
    indices += Record(kMessageIndex, content);
  }
  Append(indices);

  LittleEndianBytes index;
  index.Add(chunk_times_.first).Add(chunk_times_.last);
  index.Add(begin).Add(static_cast<uint64_t>(chunk_record.size()));
  AddText(offsets.bytes(), &index);
  index.Add(static_cast<uint64_t>(indices.size()));
  AddText("zstd", &index);
  index.Add(static_cast<uint64_t>(packed.size())).Add(static_cast<uint64_t>(chunk_.size()));
  chunk_indices_ += Record(kChunkIndex, index);
  ++num_chunks_;
  chunk_.clear();
  index_.clear();
}

std::string McapWriter::Statistics() const {
  LittleEndianBytes counts;
  uint64_t num_messages = 0;
  for (const auto& [channel, count] : num_messages_) {
    counts.Add(channel).Add(static_cast<uint64_t>(count));
    num_messages += count;
  }
  LittleEndianBytes content;
  content.Add(num_messages).Add(static_cast<uint16_t>(schemas_.size()));
  content.Add(static_cast<uint32_t>(num_messages_.size()));
  content.Add(uint32_t{0}).Add(uint32_t{0});  // attachments, metadata
  content.Add(num_chunks_).Add(times_.first).Add(times_.last);
  AddText(counts.bytes(), &content);
  return Record(kStatistics, content);
}

void McapWriter::Finish() {
  if (!chunk_.empty()) WriteChunk();
  Append(Record(kDataEnd, LittleEndianBytes().Add(uint32_t{0})));  // no checksum of the data
  const uint64_t begin = size_;
  std::string summary;
  std::string offsets;  // of the groups of records in the summary
  const auto add_group = [&](Opcode opcode, const std::string& records) {
    if (records.empty()) return;
    offsets += Record(kSummaryOffset, LittleEndianBytes()
                                          .Add(static_cast<uint8_t>(opcode))
                                          .Add(static_cast<uint64_t>(begin + summary.size()))
                                          .Add(static_cast<uint64_t>(records.size())));
    summary += records;
  };
  add_group(kSchema, schema_records_);
  add_group(kChannel, channel_records_);
  add_group(kStatistics, Statistics());
  add_group(kChunkIndex, chunk_indices_);
  const uint64_t offsets_begin = begin + summary.size();
  summary += offsets;
  constexpr uint64_t kFooterBytes = 2 * sizeof(uint64_t) + sizeof(uint32_t);
  summary += LittleEndianBytes()
                 .Add(static_cast<uint8_t>(kFooter))
                 .Add(kFooterBytes)
                 .Add(begin)
                 .Add(offsets_begin)
                 .bytes();
  Append(summary + LittleEndianBytes().Add(Checksum(summary)).Append(kMagic).bytes());
}

}  // namespace msc_vo
