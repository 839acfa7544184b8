// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <cstdint>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <vector>

#include <ros/serialization.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>

#include "msc_vo/ros_bag/bag_formats.h"
#include "msc_vo/ros_bag/little_endian_fields.h"
#include "msc_vo/text/files.h"

namespace msc_vo {

namespace {

constexpr char kReindex[] =
    "; if its recording or a copy was cut off, 'rosbag reindex' repairs a copy of it";

std::string BytesOf(const rosbag::MessageInstance& message) {
  std::string bytes(message.size(), '\0');
  ros::serialization::OStream stream(reinterpret_cast<uint8_t*>(bytes.data()),
                                     static_cast<uint32_t>(bytes.size()));
  message.write(stream);
  return bytes;
}

// rosbag_storage allocates the length that the first record claims, before it reads the record.
void CheckFirstRecord(const std::string& path) {
  constexpr size_t kMagicBytes = 13;  // "#ROSBAG V2.0" and the end of the line
  const std::string bytes = ReadBeginning(path, kMagicBytes + sizeof(uint32_t));
  LittleEndianFields fields(bytes);
  fields.Take(kMagicBytes);
  if (fields.Read<uint32_t>() > std::filesystem::file_size(path)) {
    throw std::runtime_error("its first record is longer than the file");
  }
}

class Ros1Bag : public BagFile {
 public:
  explicit Ros1Bag(const std::string& path) : BagFile(path) {
    bag_.open(path, rosbag::bagmode::Read);
    std::vector<BagTopic> topics;
    for (const rosbag::ConnectionInfo* connection : rosbag::View(bag_).getConnections()) {
      topics.push_back({connection->topic, connection->datatype, RosSerialization::kRos1});
    }
    SetTopics(std::move(topics));
  }

 private:
  struct Messages {
    std::unique_ptr<rosbag::View> view;
    std::vector<rosbag::MessageInstance> instances;
  };

  int DoCount(const BagTopic& topic) const override {
    return static_cast<int>(MessagesOf(topic).size());
  }
  std::string DoRead(const BagTopic& topic, int i) const override {
    return BytesOf(MessagesOf(topic).at(static_cast<size_t>(i)));
  }
  double DoReceiveTime(const BagTopic& topic, int i) const override {
    const ros::Time time = MessagesOf(topic).at(static_cast<size_t>(i)).getTime();
    return SecondsOf(time.sec, time.nsec);
  }

  const std::vector<rosbag::MessageInstance>& MessagesOf(const BagTopic& topic) const {
    Messages& messages = messages_[topic.name];
    if (!messages.view) {
      messages.view = std::make_unique<rosbag::View>(bag_, rosbag::TopicQuery(topic.name));
      for (const rosbag::MessageInstance& message : *messages.view) {
        messages.instances.push_back(message);
      }
    }
    return messages.instances;
  }

  rosbag::Bag bag_;
  mutable std::map<std::string, Messages> messages_;  // by topic, made when first asked for
};

}  // namespace

std::unique_ptr<BagFile> OpenRos1Bag(const std::string& path) {
  try {
    CheckFirstRecord(path);
    return std::make_unique<Ros1Bag>(path);
  } catch (const rosbag::BagUnindexedException&) {
    throw std::runtime_error(path + ": the bag has no index" + kReindex);
  } catch (const std::exception& error) {
    throw std::runtime_error(path + ": cannot be read as a bag of ROS 1: " + error.what() +
                             kReindex);
  }
}

}  // namespace msc_vo
