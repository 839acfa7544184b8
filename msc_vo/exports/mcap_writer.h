// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "msc_vo/text/files.h"

namespace msc_vo {

/// A type of message of ROS 2.
struct McapSchema {
  std::string name;        ///< "geometry_msgs/msg/PoseStamped"
  std::string definition;  ///< with those of all types in it, as rosbag2 joins them
};

/// Writes an MCAP file (mcap.dev/spec) of the profile ros2: messages in chunks packed with zstd,
/// each with its index, then a summary with checksum, by which readers find any message. The file
/// grows by whole chunks; one that was cut off is readable as far as it goes.
class McapWriter {
 public:
  /// An existing file is replaced. All functions throw std::runtime_error, naming the file, if it
  /// cannot be written.
  explicit McapWriter(const std::string& path);

  /// Returns the number of the channel of a topic. Channels with the same name of a schema share
  /// the schema.
  uint16_t AddChannel(const std::string& topic, const McapSchema& schema);
  /// Adds a message in CDR. `nanoseconds`: since 1970.
  void Write(uint16_t channel, uint64_t nanoseconds, std::string_view message);
  /// Writes the last chunk and the summary. Nothing may follow.
  void Finish();

 private:
  struct TimeRange {
    uint64_t first = 0;
    uint64_t last = 0;
    void Extend(uint64_t time, bool is_first);
  };

  void Append(const std::string& bytes);
  void WriteChunk();
  std::string Statistics() const;

  GrowingFile file_;
  uint64_t size_ = 0;  // of the file so far
  std::map<std::string, uint16_t> schemas_;
  std::string schema_records_;
  std::string channel_records_;
  std::string chunk_indices_;
  std::map<uint16_t, uint32_t> num_messages_;  // by channel
  uint32_t num_chunks_ = 0;
  TimeRange times_;
  // The present chunk.
  std::string chunk_;
  TimeRange chunk_times_;
  std::map<uint16_t, std::vector<std::pair<uint64_t, uint64_t>>> index_;  // times and positions
};

}  // namespace msc_vo
