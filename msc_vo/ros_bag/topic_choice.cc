// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/ros_bag/topic_choice.h"

#include <algorithm>
#include <functional>

#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace {

bool Contains(const ImageTopic& topic, const char* part) {
  return Lowercase(topic.name).find(part) != std::string::npos;
}

bool IsInfrared(const ImageTopic& topic) {
  return Contains(topic, "/ir") || Contains(topic, "infra");
}

bool IsRegistered(const ImageTopic& topic) {
  return Contains(topic, "registered") || Contains(topic, "aligned");
}

std::vector<ImageTopic> Rank(std::vector<ImageTopic> topics,
                             const std::function<bool(const ImageTopic&)>& fits,
                             const std::function<int(const ImageTopic&)>& penalty) {
  topics.erase(std::remove_if(topics.begin(), topics.end(),
                              [&](const ImageTopic& topic) { return !fits(topic); }),
               topics.end());
  std::stable_sort(topics.begin(), topics.end(), [&](const ImageTopic& a, const ImageTopic& b) {
    return penalty(a) < penalty(b);
  });
  return topics;
}

}  // namespace

std::vector<ImageTopic> RankColorTopics(std::vector<ImageTopic> topics) {
  return Rank(
      std::move(topics),
      [](const ImageTopic& topic) {
        return (topic.kind == RosImageKind::kColor || topic.kind == RosImageKind::kGray) &&
               !IsInfrared(topic);
      },
      [](const ImageTopic& topic) {
        const bool is_gray = topic.kind == RosImageKind::kGray;
        return (is_gray ? 2 : 0) + (topic.is_compressed ? 1 : 0);
      });
}

std::vector<ImageTopic> RankDepthTopics(std::vector<ImageTopic> topics) {
  return Rank(
      std::move(topics),
      [](const ImageTopic& topic) {
        return topic.kind == RosImageKind::kDepth && !IsInfrared(topic);
      },
      [](const ImageTopic& topic) {
        return (IsRegistered(topic) ? 0 : 2) + (topic.is_compressed ? 1 : 0);
      });
}

std::string CameraInfoTopicOf(const std::string& image_topic) {
  std::string topic = image_topic;
  for (const std::string transport : {"/compressed", "/compressedDepth"}) {
    if (topic.size() > transport.size() &&
        topic.compare(topic.size() - transport.size(), transport.size(), transport) == 0) {
      topic.erase(topic.size() - transport.size());
    }
  }
  return topic.substr(0, topic.rfind('/')) + "/camera_info";
}

}  // namespace msc_vo
