// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <vector>

#include <yaml-cpp/yaml.h>

#include "msc_vo/datasets/image_name.h"
#include "msc_vo/ros_bag/bag_formats.h"
#include "msc_vo/text/files.h"

namespace msc_vo {

namespace {

// The messages of several files, one after the other.
class SplitBag : public BagFile {
 public:
  SplitBag(const std::string& folder, std::vector<std::unique_ptr<BagFile>> parts,
           const std::vector<std::string>& warnings)
      : BagFile(folder), parts_(std::move(parts)) {
    for (const std::string& warning : warnings) Warn(warning);
    std::vector<BagTopic> topics;
    for (const auto& part : parts_) {
      topics.insert(topics.end(), part->topics().begin(), part->topics().end());
      for (const std::string& warning : part->warnings()) Warn(warning);
    }
    SetTopics(std::move(topics));
  }

 private:
  int DoCount(const BagTopic& topic) const override {
    int count = 0;
    for (const auto& part : parts_) count += CountIn(*part, topic);
    return count;
  }
  std::string DoRead(const BagTopic& topic, int i) const override {
    const BagFile& part = PartOf(topic, &i);
    return part.Read(topic.name, i);
  }
  double DoReceiveTime(const BagTopic& topic, int i) const override {
    const BagFile& part = PartOf(topic, &i);
    return part.ReceiveTime(topic.name, i);
  }

  static int CountIn(const BagFile& part, const BagTopic& topic) {
    return part.FindTopic(topic.name) == nullptr ? 0 : part.NumMessages(topic.name);
  }
  // The file that has message i, which becomes its number in that file.
  const BagFile& PartOf(const BagTopic& topic, int* i) const {
    for (const auto& part : parts_) {
      const int count = CountIn(*part, topic);
      if (*i < count) return *part;
      *i -= count;
    }
    throw std::runtime_error("the bag has no such message");
  }

  std::vector<std::unique_ptr<BagFile>> parts_;
};

std::vector<std::string> FilesOfMetadata(const std::string& path) {
  try {
    const YAML::Node information =
        YAML::Load(ReadFile(path, kMaxOptionsBytes))["rosbag2_bagfile_information"];
    const auto names = information["relative_file_paths"].as<std::vector<std::string>>();
    if (names.empty()) throw std::runtime_error("it lists no file");
    return names;
  } catch (const YAML::Exception& error) {
    throw std::runtime_error(path + ": cannot be read as the metadata of a bag of ROS 2: " +
                             error.what() + "; without it, the files of the folder are used");
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(path + ": " + error.what() +
                             "; without it, the files of the folder are used");
  }
}

std::vector<std::string> FilesOfFolder(const std::string& folder) {
  std::vector<std::string> names;
  for (const std::string& path : ListFolder(folder)) {
    if (!IsFolder(path) && IsBag(path)) {
      names.push_back(std::filesystem::path(path).filename().string());
    }
  }
  std::sort(names.begin(), names.end(), NaturalLess);
  return names;
}

// The path of a listed file; one that was compressed later, or unpacked, has another ending.
std::string FindFile(const std::string& folder, const std::string& name) {
  const std::filesystem::path path = std::filesystem::path(folder) / name;
  if (HasEntry(path.string())) return path.string();
  if (HasEntry(path.string() + ".zstd")) return path.string() + ".zstd";
  if (path.extension() == ".zstd" && HasEntry((path.parent_path() / path.stem()).string())) {
    return (path.parent_path() / path.stem()).string();
  }
  throw std::runtime_error(path.string() +
                           ": does not exist, although the metadata.yaml beside it lists it; put "
                           "it back, or give one of the files of the bag");
}

}  // namespace

std::unique_ptr<BagFile> OpenBagFolder(const std::string& folder) {
  const std::string metadata = (std::filesystem::path(folder) / "metadata.yaml").string();
  const std::vector<std::string> names =
      HasEntry(metadata) ? FilesOfMetadata(metadata) : FilesOfFolder(folder);
  std::vector<std::unique_ptr<BagFile>> parts;
  std::vector<std::string> warnings;
  for (const std::string& name : names) {
    const std::string path = FindFile(folder, name);
    // A recorder that was killed may have begun a file.
    std::error_code ignored;
    if (names.size() > 1 && std::filesystem::file_size(path, ignored) == 0) {
      warnings.push_back(path + ": is empty and is left out");
      continue;
    }
    parts.push_back(OpenBagFile(path));
  }
  if (parts.size() == 1 && warnings.empty()) return std::move(parts.front());
  return std::make_unique<SplitBag>(folder, std::move(parts), warnings);
}

}  // namespace msc_vo
