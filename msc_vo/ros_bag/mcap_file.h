// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <fstream>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace msc_vo {

/// A channel of an MCAP file.
struct McapChannel {
  std::string topic;
  std::string schema;    ///< "sensor_msgs/msg/Image"
  std::string encoding;  ///< of the messages: "cdr", "ros1"
};

/// A message in an MCAP file.
struct McapMessage {
  uint16_t channel = 0;
  uint64_t log_time = 0;  ///< nanoseconds
  int chunk = -1;         ///< in which it is; -1: it is in none
  uint64_t offset = 0;    ///< of its record, in the unpacked chunk or in the file
};

/// The container format MCAP (mcap.dev/spec), for reading. The file is gone through from its begin,
/// so that a recording that was cut off is read as far as it goes; chunks are unpacked when their
/// messages are asked for, or if the file does not index them. Lengths are believed only as far as
/// there are bytes. Not thread-safe.
class McapFile {
 public:
  /// Throws std::runtime_error that says what is wrong if the file or each of its chunks is
  /// damaged, or they are compressed in an unknown way.
  explicit McapFile(const std::string& path);

  const std::map<uint16_t, McapChannel>& channels() const { return channels_; }
  /// In the order of the file.
  const std::vector<McapMessage>& messages() const { return messages_; }
  /// Whether the end of the file is missing.
  bool is_cut_off() const { return is_cut_off_; }
  int num_chunks() const { return static_cast<int>(chunks_.size()); }
  /// Chunks that were unpacked to list their messages and are damaged. They have no messages.
  int num_damaged_chunks() const { return num_damaged_chunks_; }

  /// Returns the data of a message. Throws std::runtime_error if they are damaged.
  std::string Read(const McapMessage& message);

 private:
  struct Record {
    uint8_t opcode = 0;
    uint64_t begin = 0;  // of the content, in the file or chunk
    uint64_t size = 0;
    uint64_t end() const { return begin + size; }
  };
  struct Chunk {
    uint64_t begin = 0;  // of the compressed records, in the file
    uint64_t size = 0;
    uint64_t unpacked_size = 0;
    uint32_t crc = 0;  // 0: none
    std::string compression;
    bool is_indexed = false;
  };

  void GoThroughFile();
  // Returns false at the end, also if that is missing.
  bool ReadRecord(uint64_t at, Record* record);
  void AddRecord(const Record& record);
  void AddDefinition(uint8_t opcode, std::string_view content);
  void AddChunk(const Record& record);
  void AddIndex(const Record& record);
  // Of a file that was cut off, the last chunk may lack a part of its index.
  void ForgetLastIndex();
  void ReadUnindexedChunks();
  void GoThroughChunk(int chunk, bool with_messages);
  std::string ReadBytes(uint64_t begin, uint64_t size);
  std::shared_ptr<const std::string> Unpack(int chunk);

  std::ifstream file_;
  uint64_t size_ = 0;
  bool is_cut_off_ = false;
  int num_damaged_chunks_ = 0;
  std::map<uint16_t, std::string> schemas_;
  std::map<uint16_t, McapChannel> channels_;
  std::vector<Chunk> chunks_;
  std::vector<McapMessage> messages_;
  // The chunks that were unpacked last, which have the next images of both streams.
  std::vector<std::pair<int, std::shared_ptr<const std::string>>> unpacked_;
};

}  // namespace msc_vo
