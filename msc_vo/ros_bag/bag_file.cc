// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/ros_bag/bag_file.h"

#include <cstdint>
#include <fstream>
#include <map>
#include <stdexcept>

#include <ros/serialization.h>

#include "msc_vo/datasets/recording_file.h"
#include "msc_vo/ros_bag/ros_message.h"
#include "msc_vo/text/files.h"

namespace msc_vo {

namespace {

constexpr char kMagic[] = "#ROSBAG V2.0";

[[noreturn]] void FailUnindexed(const std::string& path) {
  throw std::runtime_error(
      path +
      ": the bag has no index, because its recording was cut off; repair a copy "
      "of it with 'rosbag reindex'");
}

bool HasMagic(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string bytes(sizeof(kMagic) - 1, '\0');
  return file.read(bytes.data(), static_cast<std::streamsize>(bytes.size())) && bytes == kMagic;
}

std::string BytesOf(const rosbag::MessageInstance& message) {
  std::string bytes(message.size(), '\0');
  ros::serialization::OStream stream(reinterpret_cast<uint8_t*>(bytes.data()),
                                     static_cast<uint32_t>(bytes.size()));
  message.write(stream);
  return bytes;
}

}  // namespace

BagFile::BagFile(const std::string& path) : path_(path), bag_(std::make_unique<rosbag::Bag>()) {
  const std::string problem = FileProblem(path, UINTMAX_MAX);
  if (!problem.empty()) throw std::runtime_error(path + ": " + problem);
  const std::string file = HasMagic(path) ? "" : DescribeFile(path);
  if (!file.empty()) throw std::runtime_error(path + " " + file);
  try {
    bag_->open(path, rosbag::bagmode::Read);
    rosbag::View all(*bag_);
    std::map<std::string, std::string> types;
    for (const rosbag::ConnectionInfo* connection : all.getConnections()) {
      types[connection->topic] = connection->datatype;
    }
    for (const auto& [name, type] : types) topics_.push_back({name, type});
  } catch (const rosbag::BagUnindexedException&) {
    FailUnindexed(path);
  } catch (const std::exception& error) {
    throw std::runtime_error(path + ": cannot be read as a bag of ROS 1 (" + kMagic +
                             "): " + error.what());
  }
}

int BagFile::Select(const std::string& topic) {
  const std::lock_guard<std::mutex> lock(mutex_);
  Selection selection;
  selection.topic = topic;
  selection.view = std::make_unique<rosbag::View>(*bag_, rosbag::TopicQuery(topic));
  for (const rosbag::MessageInstance& message : *selection.view) {
    selection.messages.push_back(message);
  }
  selections_.push_back(std::move(selection));
  return static_cast<int>(selections_.back().messages.size());
}

const BagFile::Selection& BagFile::Find(const std::string& topic) const {
  for (const Selection& selection : selections_) {
    if (selection.topic == topic) return selection;
  }
  throw std::invalid_argument("BagFile: " + topic + " is not selected");
}

std::string BagFile::Read(const std::string& topic, int i) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  try {
    return BytesOf(Find(topic).messages.at(static_cast<size_t>(i)));
  } catch (const std::exception& error) {
    throw std::runtime_error(NameOf(topic, i) + ": " + error.what());
  }
}

double BagFile::ReceiveTime(const std::string& topic, int i) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  const ros::Time time = Find(topic).messages.at(static_cast<size_t>(i)).getTime();
  return SecondsOf(time.sec, time.nsec);
}

std::string BagFile::ReadFirst(const std::string& topic) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  rosbag::View view(*bag_, rosbag::TopicQuery(topic));
  try {
    return view.begin() == view.end() ? "" : BytesOf(*view.begin());
  } catch (const std::exception& error) {
    throw std::runtime_error(NameOf(topic, 0) + ": " + error.what());
  }
}

std::string BagFile::NameOf(const std::string& topic, int i) const {
  return path_ + ":" + topic + ", message " + std::to_string(i);
}

}  // namespace msc_vo
