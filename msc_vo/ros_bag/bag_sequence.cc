// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/ros_bag/bag_sequence.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "msc_vo/datasets/camera_preset.h"
#include "msc_vo/datasets/image_pairing.h"
#include "msc_vo/datasets/tum_folder.h"
#include "msc_vo/logging/logger.h"
#include "msc_vo/ros_bag/bag_file.h"
#include "msc_vo/ros_bag/topic_choice.h"
#include "msc_vo/text/files.h"

namespace msc_vo {

namespace {

constexpr char kImageType[] = "sensor_msgs/Image";
constexpr char kCompressedType[] = "sensor_msgs/CompressedImage";
constexpr char kCameraInfoType[] = "sensor_msgs/CameraInfo";
constexpr double kUnitsOfMillimetres = 1000.0;  // raw depth units per metre
constexpr double kUnitsOfMetres = 5000.0;       // if depth in metres is written as 16 bits

// The images of two topics of a bag.
class BagContainer : public ImageContainer {
 public:
  BagContainer(std::shared_ptr<BagFile> bag, ImageTopic color, ImageTopic depth)
      : bag_(std::move(bag)), color_(std::move(color)), depth_(std::move(depth)) {}

  StoredImage ReadColor(int index) const override { return ReadImage(color_, index); }
  StoredImage ReadDepth(int index) const override { return ReadImage(depth_, index); }

 private:
  StoredImage ReadImage(const ImageTopic& topic, int index) const {
    const std::string bytes = bag_->Read(topic.name, index);
    try {
      return topic.is_compressed ? ConvertRosImage(ParseRosCompressedImage(bytes))
                                 : ConvertRosImage(ParseRosImage(bytes));
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(bag_->NameOf(topic.name, index) + ": " + error.what());
    }
  }

  std::shared_ptr<BagFile> bag_;
  ImageTopic color_;
  ImageTopic depth_;
};

// All topics with images and what their first message holds.
std::vector<ImageTopic> FindImageTopics(const BagFile& bag) {
  std::vector<ImageTopic> topics;
  for (const BagTopic& topic : bag.topics()) {
    const bool is_compressed = topic.type == kCompressedType;
    if (topic.type != kImageType && !is_compressed) continue;
    const std::string bytes = bag.ReadFirst(topic.name);
    if (bytes.empty()) continue;
    const RosImageKind kind = is_compressed ? KindOfFormat(ParseRosCompressedImage(bytes).format)
                                            : KindOfEncoding(ParseRosImage(bytes).encoding);
    topics.push_back({topic.name, kind, is_compressed});
  }
  return topics;
}

std::string NamesOf(const std::vector<ImageTopic>& topics) {
  std::string names;
  for (const ImageTopic& topic : topics) names += (names.empty() ? "" : ", ") + topic.name;
  return names.empty() ? "none" : names;
}

// The topic that the user names, or else the best one.
ImageTopic ChooseTopic(const std::string& path, const std::vector<ImageTopic>& all,
                       const std::vector<ImageTopic>& ranked, const std::string& name,
                       const std::string& what, const std::string& option,
                       std::vector<std::string>* warnings) {
  if (!name.empty()) {
    for (const ImageTopic& topic : all) {
      if (topic.name == name) return topic;
    }
    throw std::runtime_error(path + ": no images in the topic " + name + " (" + option +
                             "); topics with images: " + NamesOf(all));
  }
  if (ranked.empty()) {
    throw std::runtime_error(path + ": no topic with " + what +
                             " images found; topics with images: " + NamesOf(all));
  }
  if (ranked.size() > 1) {
    warnings->push_back("of the topics with " + what + " images " + NamesOf(ranked) +
                        ", the first is used; " + option + " names another one");
  }
  return ranked.front();
}

// Stamps of all messages of a topic, in order of time.
std::vector<ListedImage> ListImages(const ImageTopic& topic, BagFile* bag) {
  std::vector<ListedImage> images;
  const int count = bag->Select(topic.name);
  for (int i = 0; i < count; ++i) {
    const std::string name = bag->NameOf(topic.name, i);
    images.push_back({ParseRosHeader(bag->Read(topic.name, i)).stamp, name, "", i});
  }
  std::stable_sort(images.begin(), images.end(),
                   [](const ListedImage& a, const ListedImage& b) { return a.stamp < b.stamp; });
  return images;
}

void ReadCamera(const BagFile& bag, const ImageTopic& color, const ImageTopic& depth,
                SequenceIndex* index) {
  for (const ImageTopic* topic : {&color, &depth}) {
    const std::string name = CameraInfoTopicOf(topic->name);
    const auto found =
        std::find_if(bag.topics().begin(), bag.topics().end(), [&](const BagTopic& candidate) {
          return candidate.name == name && candidate.type == kCameraInfoType;
        });
    if (found == bag.topics().end()) continue;
    const std::string bytes = bag.ReadFirst(name);
    if (bytes.empty()) continue;
    const bool is_rectified = color.name.find("rect") != std::string::npos;
    std::string problem;
    index->calibration = CalibrationFrom(ParseRosCameraInfo(bytes), is_rectified, &problem);
    if (index->calibration) {
      index->calibration->origin = bag.path() + ":" + name;
      return;
    }
    index->warnings.push_back(name + " gives no calibration: " + problem);
  }
}

// Prefers the preset of a published data set to the CameraInfo, which is nominal there.
void ChooseCamera(SequenceIndex* index) {
  index->preset = GuessCameraPreset(index->directory);
  if (index->preset.empty() || !index->calibration) return;
  index->warnings.push_back("the calibration in " + index->calibration->origin +
                            " is not used, because the name of the file suggests the camera " +
                            index->preset);
  index->calibration.reset();
}

void ReadGroundTruth(const std::string& path, SequenceIndex* index) {
  const std::filesystem::path bag = path;
  const std::string truth =
      (bag.parent_path() / (bag.stem().string() + "-groundtruth.txt")).string();
  if (HasEntry(truth)) ReadGroundTruthFile(truth, WholeStamps::kTimes, index);
}

}  // namespace

bool HasRosBag() { return true; }

SequenceIndex OpenBag(const std::string& path, const BagTopics& topics) {
  const auto bag = std::make_shared<BagFile>(path);
  SequenceIndex index;
  index.format = "ros-bag";
  index.directory = path;
  const std::vector<ImageTopic> all = FindImageTopics(*bag);
  const ImageTopic color = ChooseTopic(path, all, RankColorTopics(all), topics.color, "colour",
                                       "--color-topic", &index.warnings);
  const ImageTopic depth = ChooseTopic(path, all, RankDepthTopics(all), topics.depth, "depth",
                                       "--depth-topic", &index.warnings);
  ImageLists images{ListImages(color, bag.get()), ListImages(depth, bag.get())};
  PairByTime(images, MaxPairDifference(images), &index);
  OrderEntries(&index);
  if (index.entries.empty()) {
    std::string message =
        path + ": no pair of colour and depth images in " + color.name + " and " + depth.name;
    for (const std::string& warning : index.warnings) message += "\n" + warning;
    throw std::runtime_error(message);
  }
  index.container = std::make_shared<BagContainer>(bag, color, depth);
  const StoredImage first = index.container->ReadDepth(index.entries.front().depth_index);
  const bool is_metres = first.bytes.empty() && first.pixels.type() == CV_32FC1;
  index.depth_scale = is_metres ? kUnitsOfMetres : kUnitsOfMillimetres;
  ReadCamera(*bag, color, depth, &index);
  ChooseCamera(&index);
  ReadGroundTruth(path, &index);
  Log().info("bag {}: colour {}, depth {}", path, color.name, depth.name);
  return index;
}

}  // namespace msc_vo
