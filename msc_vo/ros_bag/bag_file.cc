// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/ros_bag/bag_file.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string_view>

#include "msc_vo/datasets/recording_file.h"
#include "msc_vo/ros_bag/bag_formats.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace {

std::string EndingOf(const std::string& path) {
  return Lowercase(std::filesystem::path(path).extension().string());
}

bool IsRos2File(const std::string& path) {
  std::string ending = EndingOf(path);
  if (ending == ".zstd") ending = EndingOf(path.substr(0, path.size() - ending.size()));
  return ending == ".db3" || ending == ".mcap";
}

}  // namespace

std::string WithoutMsg(std::string type) {
  const size_t at = type.find("/msg/");
  return at == std::string::npos ? type : type.erase(at, 4);
}

void BagFile::SetTopics(std::vector<BagTopic> topics) {
  const auto earlier = [](const BagTopic& a, const BagTopic& b) { return a.name < b.name; };
  std::stable_sort(topics.begin(), topics.end(), earlier);
  const auto equal = [](const BagTopic& a, const BagTopic& b) { return a.name == b.name; };
  topics.erase(std::unique(topics.begin(), topics.end(), equal), topics.end());
  topics_ = std::move(topics);
}

const BagTopic* BagFile::FindTopic(const std::string& name) const {
  const auto found = std::find_if(topics_.begin(), topics_.end(),
                                  [&](const BagTopic& topic) { return topic.name == name; });
  return found == topics_.end() ? nullptr : &*found;
}

bool BagFile::HasMessages(const std::string& topic) const {
  return FindTopic(topic) != nullptr && NumMessages(topic) > 0;
}

const BagTopic& BagFile::Require(const std::string& name) const {
  const BagTopic* topic = FindTopic(name);
  if (topic == nullptr) throw std::invalid_argument("BagFile: no topic " + name);
  return *topic;
}

int BagFile::NumMessages(const std::string& topic) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return DoCount(Require(topic));
}

std::string BagFile::Read(const std::string& topic, int i) const {
  const BagTopic& found = Require(topic);
  const std::lock_guard<std::mutex> lock(mutex_);
  try {
    return DoRead(found, i);
  } catch (const std::exception& error) {
    throw std::runtime_error(NameOf(topic, i) + ": " + error.what());
  }
}

double BagFile::ReceiveTime(const std::string& topic, int i) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return DoReceiveTime(Require(topic), i);
}

std::string BagFile::NameOf(const std::string& topic, int i) const {
  return path_ + ":" + topic + ", message " + std::to_string(i);
}

bool IsBag(const std::string& path) {
  if (!IsFolder(path)) return EndingOf(path) == ".bag" || IsRos2File(path);
  if (!FolderProblem(path).empty()) return false;
  // Folders in it may be those of a sequence, beside which the bag lies that it came from.
  const std::vector<std::string> entries = ListFolder(path);
  return std::any_of(entries.begin(), entries.end(), IsRos2File) &&
         (HasEntry(path + "/metadata.yaml") ||
          std::none_of(entries.begin(), entries.end(), IsFolder));
}

std::string BagName(const std::string& path) {
  std::filesystem::path name = std::filesystem::path(path).lexically_normal();
  if (!name.has_filename()) name = name.parent_path();  // "a/kitchen/"
  name = name.filename();
  if (IsFolder(path)) return name.string();
  if (EndingOf(name.string()) == ".zstd") name = name.stem();
  return name.stem().string();
}

std::unique_ptr<BagFile> OpenBagFile(const std::string& path) {
  if (IsFolder(path)) return OpenBagFolder(path);
  const std::string problem = FileProblem(path, UINTMAX_MAX);
  if (!problem.empty()) throw std::runtime_error(path + ": " + problem);
  using std::string_view_literals::operator""sv;
  const std::string bytes = ReadBeginning(path, 16);
  const auto begins_with = [&](std::string_view magic) {
    return bytes.compare(0, magic.size(), magic) == 0;
  };
  if (begins_with("SQLite format 3\0"sv) || begins_with("\x89MCAP"sv) ||
      (begins_with("\x28\xb5\x2f\xfd"sv) && IsRos2File(path))) {
    return OpenRos2Bag(path);
  }
  if (begins_with("#ROSBAG V2.0"sv)) return OpenRos1Bag(path);
  if (bytes.empty()) throw std::runtime_error(path + ": is empty; restore a copy, or remove it");
  const std::string file = IsRos2File(path) ? "" : DescribeFile(path);
  throw std::runtime_error(
      file.empty() ? path +
                         ": is no bag that can be read: neither one of ROS 1 (#ROSBAG V2.0) nor "
                         "an SQLite or MCAP file of ROS 2; restore a copy"
                   : path + " " + file);
}

}  // namespace msc_vo
