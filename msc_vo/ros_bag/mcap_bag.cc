// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <stdexcept>
#include <utility>
#include <vector>

#include "msc_vo/ros_bag/bag_formats.h"
#include "msc_vo/ros_bag/decompression.h"
#include "msc_vo/ros_bag/mcap_file.h"
#include "msc_vo/ros_bag/ros_message.h"
#include "msc_vo/ros_bag/topic_messages.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

constexpr char kRecover[] = "; 'mcap recover' repairs a copy of a damaged file";

// Others are protobuf, JSON and so on.
bool IsOfRos(const McapChannel& channel) {
  return channel.encoding == "cdr" || channel.encoding == "ros1";
}

BagTopic TopicOf(const McapChannel& channel) {
  return {channel.topic, WithoutMsg(channel.schema),
          channel.encoding == "ros1" ? RosSerialization::kRos1 : RosSerialization::kCdr};
}

class McapBag : public BagFile {
 public:
  McapBag(const std::string& path, const std::string& file) : BagFile(path), file_(file) {
    std::vector<BagTopic> topics;
    for (const auto& [id, channel] : file_.channels()) {
      if (IsOfRos(channel)) topics.push_back(TopicOf(channel));
    }
    SetTopics(std::move(topics));
    for (const McapMessage& message : file_.messages()) {
      const auto channel = file_.channels().find(message.channel);
      if (channel == file_.channels().end() || !IsOfRos(channel->second)) continue;
      const BagTopic own = TopicOf(channel->second);
      const BagTopic& topic = *FindTopic(own.name);  // possibly of another channel
      if (own.type == topic.type && own.serialization == topic.serialization) {
        messages_.Add(own.name, message);
      }
    }
    if (file_.num_damaged_chunks() > 0) {
      Warn(path +
           FormatText(": %d of %d chunks are damaged; their messages are left out",
                      file_.num_damaged_chunks(), file_.num_chunks()) +
           kRecover);
    }
    if (file_.is_cut_off()) {
      Warn(path + ": the end of the recording is missing; it is read as far as it goes");
    }
  }

 private:
  int DoCount(const BagTopic& topic) const override { return messages_.Count(topic.name); }
  std::string DoRead(const BagTopic& topic, int i) const override {
    return UnpackMessage(file_.Read(messages_.At(topic.name, i)));
  }
  double DoReceiveTime(const BagTopic& topic, int i) const override {
    return SecondsOf(static_cast<int64_t>(messages_.At(topic.name, i).log_time));
  }

  mutable McapFile file_;
  TopicMessages<McapMessage> messages_;
};

}  // namespace

std::unique_ptr<BagFile> OpenMcapBag(const std::string& path, const std::string& file) {
  try {
    return std::make_unique<McapBag>(path, file);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(path + ": cannot be read as an MCAP file: " + error.what() + kRecover);
  }
}

}  // namespace msc_vo
