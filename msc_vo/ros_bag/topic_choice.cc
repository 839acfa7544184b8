// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/ros_bag/topic_choice.h"

#include <algorithm>
#include <cctype>
#include <initializer_list>
#include <tuple>
#include <utility>

#include "msc_vo/geometry/erase_if.h"
#include "msc_vo/text/ending.h"

namespace msc_vo {

namespace {

// Behind the name of a stream in recordings of the RealSense viewer.
constexpr char kRealSenseImage[] = "/image/data";

unsigned char Byte(char c) { return static_cast<unsigned char>(c); }

bool HasWord(const ImageTopic& topic, std::initializer_list<const char*> words) {
  const std::vector<std::string> own = TopicWords(topic.name);
  return std::find_first_of(own.begin(), own.end(), words.begin(), words.end()) != own.end();
}

bool IsInfrared(const ImageTopic& topic) {
  return HasWord(topic, {"ir", "nir", "lwir", "infra", "infrared", "thermal"});
}

bool IsNamedDepth(const ImageTopic& topic) { return HasWord(topic, {"depth", "disparity"}); }

// Number of path elements that two names have in common at their beginning.
size_t CommonElements(const std::string& a, const std::string& b) {
  const auto different = std::mismatch(a.begin(), a.end(), b.begin(), b.end()).first;
  return static_cast<size_t>(std::count(a.begin(), different, '/'));
}

// Keeps the topics that fit, in the order of their penalties.
template <typename Fits, typename Penalty>
std::vector<ImageTopic> Rank(std::vector<ImageTopic> topics, const Fits& fits,
                             const Penalty& penalty) {
  EraseIf(&topics, [&](const ImageTopic& topic) { return !fits(topic); });
  std::stable_sort(topics.begin(), topics.end(), [&](const ImageTopic& a, const ImageTopic& b) {
    return penalty(a) < penalty(b);
  });
  return topics;
}

}  // namespace

std::vector<std::string> TopicWords(const std::string& name) {
  const auto is_upper = [&](size_t i) { return i < name.size() && std::isupper(Byte(name[i])); };
  const auto is_lower = [&](size_t i) { return i < name.size() && std::islower(Byte(name[i])); };
  std::vector<std::string> words;
  std::string word;
  for (size_t i = 0; i <= name.size(); ++i) {
    const bool is_letter = is_upper(i) || is_lower(i);
    // "depthImage", "IRImage"
    const bool begins =
        is_upper(i) && i > 0 && (is_lower(i - 1) || (is_upper(i - 1) && is_lower(i + 1)));
    if ((!is_letter || begins) && !word.empty()) words.push_back(std::exchange(word, ""));
    if (is_letter) word += static_cast<char>(std::tolower(Byte(name[i])));
  }
  return words;
}

std::vector<ImageTopic> RankDepthTopics(std::vector<ImageTopic> topics) {
  return Rank(
      std::move(topics),
      [](const ImageTopic& topic) {
        return topic.kind == RosImageKind::kDepth && !IsInfrared(topic);
      },
      [](const ImageTopic& topic) {
        return std::tuple(!IsRegistered(topic), topic.is_compressed);
      });
}

std::vector<ImageTopic> RankColorTopics(std::vector<ImageTopic> topics,
                                        const std::string& depth_topic) {
  return Rank(
      std::move(topics),
      [](const ImageTopic& topic) {
        return (topic.kind == RosImageKind::kColor || topic.kind == RosImageKind::kGray) &&
               !IsInfrared(topic);
      },
      [&](const ImageTopic& topic) {
        const size_t common = CommonElements(topic.name, depth_topic);
        return std::tuple(topic.kind == RosImageKind::kGray, IsNamedDepth(topic),
                          depth_topic.size() - common, topic.is_compressed);
      });
}

std::string DescribeTopic(const ImageTopic& topic) {
  std::string text = topic.name + " (";
  switch (topic.kind) {
    case RosImageKind::kColor:
      text += "colour";
      break;
    case RosImageKind::kGray:
      text += "grey";
      break;
    case RosImageKind::kDepth:
      text += IsRegistered(topic) ? "depth, registered" : "depth";
      break;
    case RosImageKind::kOther:
      text += "neither colour nor depth";
      if (!topic.encoding.empty()) text += ": " + topic.encoding;
      break;
  }
  if (topic.is_compressed) text += ", compressed";
  if (IsInfrared(topic)) text += ", infrared";
  if (topic.kind != RosImageKind::kDepth && IsNamedDepth(topic)) text += ", named as depth";
  return text + ")";
}

bool IsRegistered(const ImageTopic& topic) {
  return HasWord(topic, {"registered", "aligned"}) && !HasWord(topic, {"no", "not", "non", "un"});
}

bool IsRectified(const ImageTopic& topic) {
  return HasWord(topic, {"rect", "rectified", "undistorted", "undist"}) &&
         !HasWord(topic, {"no", "not", "non", "un"});
}

std::string CameraInfoTopicOf(const std::string& image_topic) {
  std::string topic = image_topic;
  const auto remove_ending = [&topic](const std::string& ending) {
    const bool ends = topic != ending && HasEnding(topic, ending);
    if (ends) topic.erase(topic.size() - ending.size());
    return ends;
  };
  if (remove_ending(kRealSenseImage)) return topic + "/info/camera_info";
  remove_ending("/compressed");
  remove_ending("/compressedDepth");
  return topic.substr(0, topic.rfind('/')) + "/camera_info";
}

}  // namespace msc_vo
