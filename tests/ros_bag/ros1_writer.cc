// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <cstring>

#include "tests/ros_bag/bag_writer.h"
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

namespace {

class Ros1Writer : public BagWriter {
 public:
  Ros1Writer(const std::string& path, const std::string& compression)
      : BagWriter(RosSerialization::kRos1) {
    bag_.open(path, rosbag::bagmode::Write);
    bag_.setCompression(compression == "bz2"   ? rosbag::compression::BZ2
                        : compression == "lz4" ? rosbag::compression::LZ4
                                               : rosbag::compression::Uncompressed);
  }
  ~Ros1Writer() override { bag_.close(); }

  void Write(const std::string& topic, const std::string& type, double seconds,
             const std::string& bytes) override {
    SerialisedMessage message{type, "", bytes};
    message.md5 = type == "sensor_msgs/Image"             ? "060021388200f6f0f447d0fcd9c64743"
                  : type == "sensor_msgs/CompressedImage" ? "8f7a12909da2c9d3332d540a0977563f"
                                                          : "c9a58c1b0b154e0e6da7578cb991d214";
    bag_.write(topic, ros::Time(seconds), message);
  }

 private:
  rosbag::Bag bag_;
};

}  // namespace

std::unique_ptr<BagWriter> WriteRos1Bag(const std::string& path, const std::string& compression) {
  return std::make_unique<Ros1Writer>(path, compression);
}

}  // namespace msc_vo
