// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "msc_vo/ros_bag/ros_message.h"

namespace msc_vo {

/// A topic of a bag.
struct BagTopic {
  std::string name;
  std::string type;  ///< "sensor_msgs/Image", in bags of ROS 2 too
  RosSerialization serialization = RosSerialization::kRos1;
};

/// Returns the name of a type of ROS 2 as ROS 1 has it: "sensor_msgs/msg/Image" ->
/// "sensor_msgs/Image".
std::string WithoutMsg(std::string type);

/// A bag of ROS 1 or 2 with random access to its messages. Thread-safe.
class BagFile {
 public:
  virtual ~BagFile() = default;

  /// The file, or the folder of a bag in several files.
  const std::string& path() const { return path_; }
  /// In the order of their names.
  const std::vector<BagTopic>& topics() const { return topics_; }
  /// Null if the bag has no such topic.
  const BagTopic* FindTopic(const std::string& name) const;
  /// Tests whether the bag has a topic, and messages in it.
  bool HasMessages(const std::string& topic) const;
  /// What is wrong with the bag although it can be read, one sentence each.
  const std::vector<std::string>& warnings() const { return warnings_; }

  /// Number of the messages of a topic. Here and below, a topic that the bag does not have throws
  /// std::invalid_argument.
  int NumMessages(const std::string& topic) const;
  /// Bytes of message i of a topic, in the order of recording. Throws std::runtime_error, naming
  /// file, topic and message, if they cannot be read.
  std::string Read(const std::string& topic, int i) const;
  /// Returns `parse(bytes, serialization)` of message i of a topic; views into the bytes end with
  /// the call. Errors of `parse`, std::runtime_error, get the name of the message.
  template <typename Function>
  auto Parse(const std::string& topic, int i, const Function& parse) const {
    const std::string bytes = Read(topic, i);
    try {
      return parse(std::string_view(bytes), Require(topic).serialization);
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(NameOf(topic, i) + ": " + error.what());
    }
  }
  /// Time at which message i of a topic was recorded, seconds.
  double ReceiveTime(const std::string& topic, int i) const;
  /// "x.bag:/camera/depth, message 12", for messages.
  std::string NameOf(const std::string& topic, int i) const;

 protected:
  explicit BagFile(std::string path) : path_(std::move(path)) {}
  /// Sorts the topics by name; of two with one name, the first stays.
  void SetTopics(std::vector<BagTopic> topics);
  void Warn(const std::string& warning) { warnings_.push_back(warning); }

 private:
  // These are called with topics of the bag, by one thread at a time; DoRead() throws
  // std::runtime_error that says what is wrong with the message.
  virtual int DoCount(const BagTopic& topic) const = 0;
  virtual std::string DoRead(const BagTopic& topic, int i) const = 0;
  virtual double DoReceiveTime(const BagTopic& topic, int i) const = 0;
  const BagTopic& Require(const std::string& topic) const;

  std::string path_;
  std::vector<BagTopic> topics_;
  std::vector<std::string> warnings_;
  mutable std::mutex mutex_;  // of files, which have one position and one buffer
};

/// Tests whether a path is named as a bag: a file .bag, .db3 or .mcap, also compressed (.zstd), or
/// a folder with a file .db3 or .mcap, and with a metadata.yaml or without folders in it.
bool IsBag(const std::string& path);

/// The name of a bag without the endings of a file: "kitchen" of "a/kitchen.db3.zstd" and of the
/// folder "a/kitchen/".
std::string BagName(const std::string& path);

/// Opens a bag: a file of ROS 1, an SQLite or an MCAP file of ROS 2, or the folder of a bag of ROS
/// 2 in one or several such files. Throws std::runtime_error, naming the file and the fix, if it is
/// none, is damaged, or needs a library without which msc_vo was built.
std::unique_ptr<BagFile> OpenBagFile(const std::string& path);

}  // namespace msc_vo
