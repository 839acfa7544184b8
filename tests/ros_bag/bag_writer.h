// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>
#include <string>

#include "msc_vo/ros_bag/ros_message.h"

namespace msc_vo {

// Writes a bag from serialised messages; it is complete when the writer is destroyed.
class BagWriter {
 public:
  virtual ~BagWriter() = default;

  // `type` is "sensor_msgs/Image" and so on, "librealsense/string". `seconds`: of recording.
  virtual void Write(const std::string& topic, const std::string& type, double seconds,
                     const std::string& bytes) = 0;
  // Of the messages.
  RosSerialization serialization() const { return serialization_; }

 protected:
  explicit BagWriter(RosSerialization serialization) : serialization_(serialization) {}

 private:
  RosSerialization serialization_;
};

// "none", "bz2" or "lz4".
std::unique_ptr<BagWriter> WriteRos1Bag(const std::string& path,
                                        const std::string& compression = "none");

// "none" or "zstd", of each message.
std::unique_ptr<BagWriter> WriteDb3Bag(const std::string& path,
                                       const std::string& compression = "none");

struct McapLayout {
  std::string compression;  // of chunks: "", "zstd" or "lz4"
  bool has_chunks = true;
  bool has_index = true;  // of the messages of each chunk
};
std::unique_ptr<BagWriter> WriteMcapBag(const std::string& path, const McapLayout& layout = {},
                                        RosSerialization serialization = RosSerialization::kCdr);

// Compresses bytes or a file with zstd.
std::string Zstd(const std::string& bytes);
void CompressFile(const std::string& path, const std::string& compressed);

}  // namespace msc_vo
