// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/ros_bag/topic_choice.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
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

bool IsColorOrGray(const ImageTopic& topic) {
  return topic.kind == RosImageKind::kColor || topic.kind == RosImageKind::kGray;
}

bool IsNamedDepth(const ImageTopic& topic) { return HasWord(topic, {"depth", "disparity"}); }

// Number of path elements that two names have in common at their beginning.
std::ptrdiff_t CommonElements(const std::string& a, const std::string& b) {
  const auto different = std::mismatch(a.begin(), a.end(), b.begin(), b.end()).first;
  return std::count(a.begin(), different, '/');
}

// What is wrong with a pair of topics, the most important first.
auto PenaltiesOf(const ImageTopic& color, const ImageTopic& depth) {
  const int registration = HaveSameFrame(color, depth) ? 0 : IsRegistered(depth) ? 1 : 2;
  return std::tuple(IsNamedDepth(color), registration, !color.is_calibrated,
                    color.kind == RosImageKind::kGray, !IsRegistered(depth),
                    -CommonElements(color.name, depth.name), color.is_compressed,
                    depth.is_compressed);
}

// The word behind "depth_to"; empty if there is none.
std::string TargetOfDepth(const std::vector<std::string>& words) {
  const std::vector<std::string> depth_to = {"depth", "to"};
  const auto found = std::search(words.begin(), words.end(), depth_to.begin(), depth_to.end());
  return words.end() - found > 2 ? found[2] : "";
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

bool MayBeGray16(const ImageTopic& topic) {
  return topic.kind == RosImageKind::kDepth && topic.encoding == "mono16" && !IsNamedDepth(topic);
}

std::vector<ImageTopic> DepthTopics(std::vector<ImageTopic> topics) {
  EraseIf(&topics, [](const ImageTopic& topic) {
    return topic.kind != RosImageKind::kDepth || IsInfrared(topic);
  });
  if (!std::all_of(topics.begin(), topics.end(), MayBeGray16)) EraseIf(&topics, MayBeGray16);
  return topics;
}

std::vector<ImageTopic> ColorTopics(std::vector<ImageTopic> topics) {
  EraseIf(&topics,
          [](const ImageTopic& topic) { return !IsColorOrGray(topic) || IsInfrared(topic); });
  return topics;
}

TopicPair BestPair(const std::vector<ImageTopic>& colors, const std::vector<ImageTopic>& depths) {
  TopicPair best = {colors.at(0), depths.at(0)};
  for (const ImageTopic& depth : depths) {
    for (const ImageTopic& color : colors) {
      if (PenaltiesOf(color, depth) < PenaltiesOf(best.color, best.depth)) best = {color, depth};
    }
  }
  return best;
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
      text += MayBeGray16(topic) ? "grey with 16 bits, or depth" : "depth";
      if (IsRegistered(topic)) text += ", registered";
      break;
    case RosImageKind::kOther:
      text += "neither colour nor depth";
      if (!topic.encoding.empty()) text += ": " + topic.encoding;
      break;
  }
  if (topic.is_compressed) text += ", compressed";
  if (IsInfrared(topic)) text += ", infrared";
  if (topic.kind != RosImageKind::kDepth && IsNamedDepth(topic)) text += ", named as depth";
  if (IsColorOrGray(topic) && !topic.is_calibrated) text += ", no CameraInfo";
  return text + ")";
}

bool IsRegistered(const ImageTopic& topic) {
  if (HasWord(topic, {"no", "not", "non", "un"})) return false;
  const std::string target = TargetOfDepth(TopicWords(topic.name));
  if (!target.empty()) return target == "color" || target == "colour" || target == "rgb";
  return HasWord(topic, {"registered", "aligned"});
}

bool HaveSameFrame(const ImageTopic& a, const ImageTopic& b) {
  return !a.frame.empty() && a.frame == b.frame;
}

bool AreRegistered(const ImageTopic& depth, const ImageTopic& color) {
  return IsRegistered(depth) || HaveSameFrame(depth, color);
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
