// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include <rosbag/bag.h>
#include <rosbag/view.h>

namespace msc_vo {

/// A topic of a bag.
struct BagTopic {
  std::string name;
  std::string type;  ///< "sensor_msgs/Image"
};

/// A bag of ROS 1 with random access to the messages of some topics. Thread-safe.
class BagFile {
 public:
  /// Throws std::runtime_error, naming the file and the fix, if it is no readable bag.
  explicit BagFile(const std::string& path);

  const std::string& path() const { return path_; }
  /// In the order of their names.
  const std::vector<BagTopic>& topics() const { return topics_; }

  /// Makes the messages of a topic available, in the order of recording, and returns their number.
  int Select(const std::string& topic);
  /// Bytes of message i of a selected topic. Throws std::runtime_error, naming file, topic and
  /// message, if they cannot be read.
  std::string Read(const std::string& topic, int i) const;
  /// Time at which message i of a selected topic was recorded, seconds.
  double ReceiveTime(const std::string& topic, int i) const;
  /// Bytes of the first message of any topic; empty if there is none.
  std::string ReadFirst(const std::string& topic) const;
  /// "x.bag:/camera/depth, message 12", for messages.
  std::string NameOf(const std::string& topic, int i) const;

 private:
  struct Selection {
    std::string topic;
    std::unique_ptr<rosbag::View> view;
    std::vector<rosbag::MessageInstance> messages;
  };
  const Selection& Find(const std::string& topic) const;

  std::string path_;
  std::vector<BagTopic> topics_;
  mutable std::mutex mutex_;  // of the bag, which has one position and one buffer
  std::unique_ptr<rosbag::Bag> bag_;
  std::vector<Selection> selections_;
};

}  // namespace msc_vo
