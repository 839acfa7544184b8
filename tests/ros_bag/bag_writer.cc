// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "tests/ros_bag/bag_writer.h"

#include <cstring>

#include <ros/message_traits.h>
#include <ros/serialization.h>
#include <rosbag/bag.h>

namespace msc_vo {

struct SerialisedMessage {
  std::string type;
  std::string md5;
  std::string bytes;
};

}  // namespace msc_vo

namespace ros {
namespace message_traits {

template <>
struct MD5Sum<msc_vo::SerialisedMessage> {
  static const char* value(const msc_vo::SerialisedMessage& m) { return m.md5.c_str(); }
};
template <>
struct DataType<msc_vo::SerialisedMessage> {
  static const char* value(const msc_vo::SerialisedMessage& m) { return m.type.c_str(); }
};
template <>
struct Definition<msc_vo::SerialisedMessage> {
  static const char* value(const msc_vo::SerialisedMessage& /*m*/) { return "Header header"; }
};

}  // namespace message_traits
namespace serialization {

template <>
struct Serializer<msc_vo::SerialisedMessage> {
  template <typename Stream>
  static void write(Stream& stream, const msc_vo::SerialisedMessage& m) {
    std::memcpy(stream.advance(static_cast<uint32_t>(m.bytes.size())), m.bytes.data(),
                m.bytes.size());
  }
  static uint32_t serializedLength(const msc_vo::SerialisedMessage& m) {
    return static_cast<uint32_t>(m.bytes.size());
  }
};

}  // namespace serialization
}  // namespace ros

namespace msc_vo {

struct BagWriter::Bag {
  rosbag::Bag bag;
};

BagWriter::BagWriter(const std::string& path, BagCompression compression)
    : bag_(std::make_unique<Bag>()) {
  bag_->bag.open(path, rosbag::bagmode::Write);
  bag_->bag.setCompression(compression == BagCompression::kBz2 ? rosbag::compression::BZ2
                           : compression == BagCompression::kLz4
                               ? rosbag::compression::LZ4
                               : rosbag::compression::Uncompressed);
}

BagWriter::~BagWriter() { bag_->bag.close(); }

void BagWriter::Write(const std::string& topic, const std::string& type, double seconds,
                      const std::string& bytes) {
  SerialisedMessage message{"sensor_msgs/" + type, "", bytes};
  message.md5 = type == "Image"             ? "060021388200f6f0f447d0fcd9c64743"
                : type == "CompressedImage" ? "8f7a12909da2c9d3332d540a0977563f"
                                            : "c9a58c1b0b154e0e6da7578cb991d214";
  bag_->bag.write(topic, ros::Time(seconds), message);
}

}  // namespace msc_vo
