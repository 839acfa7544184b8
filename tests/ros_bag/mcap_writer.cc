// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <cmath>
#include <cstdint>
#include <fstream>
#include <map>
#include <vector>

#include "tests/ros_bag/bag_writer.h"
#include <lz4frame.h>
#include <zstd.h>

namespace msc_vo {

namespace {

constexpr char kMagic[] = "\x89MCAP0\r\n";

// The fields of a record.
class Content {
 public:
  template <typename Number>
  Content& Add(Number value) {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof(value));
    return *this;
  }
  Content& AddText(const std::string& text) {
    Add(static_cast<uint32_t>(text.size()));
    bytes_ += text;
    return *this;
  }
  Content& AddBytes(const std::string& bytes) {
    bytes_ += bytes;
    return *this;
  }
  // The record with its opcode and length.
  std::string As(uint8_t opcode) const {
    return Content().Add(opcode).Add(static_cast<uint64_t>(bytes_.size())).bytes_ + bytes_;
  }

 private:
  std::string bytes_;
};

std::string Compress(const std::string& bytes, const std::string& compression) {
  if (compression.empty()) return bytes;
  if (compression == "zstd") {
    std::string packed(ZSTD_compressBound(bytes.size()), '\0');
    packed.resize(ZSTD_compress(packed.data(), packed.size(), bytes.data(), bytes.size(), 1));
    return packed;
  }
  std::string packed(LZ4F_compressFrameBound(bytes.size(), nullptr), '\0');
  packed.resize(
      LZ4F_compressFrame(packed.data(), packed.size(), bytes.data(), bytes.size(), nullptr));
  return packed;
}

// Chunks of three messages; schemas and channels are in the chunk that first needs them.
class McapWriter : public BagWriter {
 public:
  McapWriter(const std::string& path, McapLayout layout, RosSerialization serialization)
      : BagWriter(serialization),
        layout_(std::move(layout)),
        file_(path, std::ios::binary),
        is_ros1_(serialization == RosSerialization::kRos1) {
    file_ << kMagic << Content().AddText(is_ros1_ ? "ros1" : "ros2").AddText("test").As(0x01);
  }
  ~McapWriter() override {
    FlushChunk();
    file_ << Content().Add(uint32_t{0}).As(0x0F)
          << Content().Add(uint64_t{0}).Add(uint64_t{0}).Add(uint32_t{0}).As(0x02) << kMagic;
  }

  void Write(const std::string& topic, const std::string& type, double seconds,
             const std::string& bytes) override {
    const auto [channel, is_new] =
        channels_.try_emplace(topic, static_cast<uint16_t>(channels_.size() + 1));
    const uint16_t id = channel->second;
    if (is_new) {
      std::string schema = type;
      if (!is_ros1_) schema.insert(type.find('/'), "/msg");
      Append(Content()
                 .Add(id)
                 .AddText(schema)
                 .AddText(is_ros1_ ? "ros1msg" : "ros2msg")
                 .AddText("")
                 .As(0x03));
      Append(Content()
                 .Add(id)
                 .Add(id)
                 .AddText(topic)
                 .AddText(is_ros1_ ? "ros1" : "cdr")
                 .AddText("")
                 .As(0x04));
    }
    const auto time = static_cast<uint64_t>(std::llround(1e9 * seconds));
    index_[id].Add(time).Add(static_cast<uint64_t>(chunk_.size()));
    Append(Content().Add(id).Add(uint32_t{0}).Add(time).Add(time).AddBytes(bytes).As(0x05));
    if (layout_.has_chunks && ++num_in_chunk_ == 3) FlushChunk();
  }

 private:
  void Append(const std::string& record) {
    if (layout_.has_chunks) {
      chunk_ += record;
    } else {
      file_ << record;
    }
  }
  void FlushChunk() {
    if (chunk_.empty()) return;
    const std::string packed = Compress(chunk_, layout_.compression);
    file_ << Content()
                 .Add(uint64_t{0})
                 .Add(uint64_t{0})
                 .Add(static_cast<uint64_t>(chunk_.size()))
                 .Add(uint32_t{0})
                 .AddText(layout_.compression)
                 .Add(static_cast<uint64_t>(packed.size()))
                 .AddBytes(packed)
                 .As(0x06);
    for (auto& [id, entries] : index_) {
      if (!layout_.has_index) continue;
      const std::string bytes = entries.As(0).substr(9);
      file_ << Content().Add(id).AddText(bytes).As(0x07);
    }
    index_.clear();
    chunk_.clear();
    num_in_chunk_ = 0;
  }

  McapLayout layout_;
  std::ofstream file_;
  bool is_ros1_;
  std::map<std::string, uint16_t> channels_;
  std::map<uint16_t, Content> index_;
  std::string chunk_;
  int num_in_chunk_ = 0;
};

}  // namespace

std::unique_ptr<BagWriter> WriteMcapBag(const std::string& path, const McapLayout& layout,
                                        RosSerialization serialization) {
  return std::make_unique<McapWriter>(path, layout, serialization);
}

}  // namespace msc_vo
