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
#include "msc_vo/ros_bag/bag_calibration.h"
#include "msc_vo/ros_bag/bag_file.h"
#include "msc_vo/ros_bag/bag_stamps.h"
#include "msc_vo/ros_bag/camera_infos.h"
#include "msc_vo/ros_bag/realsense_camera.h"
#include "msc_vo/ros_bag/topic_choice.h"
#include "msc_vo/text/ending.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/format_text.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace {

constexpr char kImageType[] = "sensor_msgs/Image";
constexpr char kCompressedType[] = "sensor_msgs/CompressedImage";
constexpr double kUnitsOfMillimetres = 1000.0;  // raw depth units per metre
constexpr double kUnitsOfMetres = 5000.0;       // if depth in metres is written as 16 bits

// The images of two topics of a bag.
class BagContainer : public ImageContainer {
 public:
  BagContainer(std::shared_ptr<const BagFile> bag, ImageTopic color, ImageTopic depth)
      : bag_(std::move(bag)), color_(std::move(color)), depth_(std::move(depth)) {}

  StoredImage ReadColor(int index) const override { return ReadImage(color_, index); }
  StoredImage ReadDepth(int index) const override { return ReadImage(depth_, index); }

 private:
  StoredImage ReadImage(const ImageTopic& topic, int index) const {
    return bag_->Parse(topic.name, index, [&](std::string_view bytes, RosSerialization form) {
      return topic.is_compressed ? ConvertRosImage(ParseRosCompressedImage(bytes, form))
                                 : ConvertRosImage(ParseRosImage(bytes, form));
    });
  }

  std::shared_ptr<const BagFile> bag_;
  ImageTopic color_;
  ImageTopic depth_;
};

// A topic with images and what message i holds.
ImageTopic ReadTopic(const BagFile& bag, const BagTopic& topic, int i) {
  ImageTopic images{topic.name, RosImageKind::kOther, topic.type == kCompressedType};
  bag.Parse(topic.name, i, [&](std::string_view bytes, RosSerialization form) {
    if (images.is_compressed) {
      const RosCompressedImage image = ParseRosCompressedImage(bytes, form);
      images.kind = KindOfCompressed(image);
      images.encoding = image.format;
      images.frame = image.header.frame;
      return;
    }
    const RosImage image = ParseRosImage(bytes, form);
    images.kind = KindOfEncoding(image.encoding);
    images.encoding = image.encoding;
    images.frame = image.header.frame;
    images.size = {static_cast<int>(image.width), static_cast<int>(image.height)};
  });
  if (IsRealSenseStream(topic.name)) images.frame.clear();
  return images;
}

// The same of the first message that can be read.
ImageTopic ReadTopic(const BagFile& bag, const BagTopic& topic) {
  constexpr int kMaxTries = 10;
  const int last = std::min(bag.NumMessages(topic.name), kMaxTries) - 1;
  for (int i = 0; i < last; ++i) {
    try {
      return ReadTopic(bag, topic, i);
    } catch (const std::runtime_error&) {  // counted by ListImages()
    }
  }
  return ReadTopic(bag, topic, last);
}

// All topics with images and what their messages hold.
std::vector<ImageTopic> FindImageTopics(const BagFile& bag, const CameraInfos& infos,
                                        std::vector<std::string>* warnings) {
  std::vector<ImageTopic> topics;
  for (const BagTopic& topic : bag.topics()) {
    const bool is_compressed = topic.type == kCompressedType;
    if (topic.type != kImageType && !is_compressed) continue;
    if (bag.NumMessages(topic.name) == 0) continue;
    try {
      ImageTopic images = ReadTopic(bag, topic);
      std::string problem;
      images.is_calibrated = infos.Find(images, &problem).has_value();
      topics.push_back(std::move(images));
    } catch (const std::runtime_error& error) {  // another topic may be good
      warnings->push_back(error.what());
      topics.push_back({topic.name, RosImageKind::kOther, is_compressed});
    }
  }
  return topics;
}

std::string Describe(const std::vector<ImageTopic>& topics, const std::string& except = "") {
  std::string text;
  for (const ImageTopic& topic : topics) {
    if (topic.name != except) text += (text.empty() ? "" : ", ") + DescribeTopic(topic);
  }
  return text.empty() ? "none" : text;
}

std::string OptionOf(const std::string& what) {
  return what == "depth" ? "--depth-topic" : "--color-topic";
}

// The topic that the user names, or else all that fit.
std::vector<ImageTopic> Candidates(const std::string& path, const std::vector<ImageTopic>& all,
                                   const std::vector<ImageTopic>& fitting, const std::string& name,
                                   const std::string& what,
                                   const std::vector<std::string>& warnings) {
  const std::string option = OptionOf(what);
  if (!name.empty()) {
    for (const ImageTopic& topic : all) {
      if (topic.name == name) return {topic};
    }
    throw std::runtime_error(path + ": no images in the topic " + name + " (" + option +
                             "); topics with images: " + Describe(all));
  }
  if (fitting.empty()) {
    std::string message = path + ": no topic with " + what +
                          " images found; topics with images: " + Describe(all) +
                          "; colour has 8 bits per channel, depth is 16UC1, 32FC1 or "
                          "compressedDepth" +
                          (all.empty() ? "" : "; " + option + " names one");
    for (const std::string& warning : warnings) message += "\n" + warning;
    throw std::runtime_error(message);
  }
  return fitting;
}

// Says which other topics would fit.
void DescribeChoice(const ImageTopic& chosen, const std::vector<ImageTopic>& candidates,
                    const std::string& what, std::vector<std::string>* warnings) {
  if (candidates.size() == 1) return;
  warnings->push_back(what + " images: " + DescribeTopic(chosen) + " is used, not " +
                      Describe(candidates, chosen.name) + "; " + OptionOf(what) +
                      " names another one");
}

TopicPair ChooseTopics(const std::string& path, const std::vector<ImageTopic>& all,
                       const BagTopics& named, std::vector<std::string>* warnings) {
  const std::vector<ImageTopic> depths =
      Candidates(path, all, DepthTopics(all), named.depth, "depth", *warnings);
  const std::vector<ImageTopic> colors =
      Candidates(path, all, ColorTopics(all), named.color, "colour", *warnings);
  TopicPair pair = BestPair(colors, depths);
  if (MayBeGray16(pair.depth) && named.depth.empty()) {
    warnings->push_back(DescribeTopic(pair.depth) + " is taken for depth in millimetres, because " +
                        "there is no other depth; --depth-topic names another one");
  }
  DescribeChoice(pair.depth, depths, "depth", warnings);
  DescribeChoice(pair.color, colors, "colour", warnings);
  return pair;
}

// Names the messages of a topic and reads their times, in the order of recording. Damaged ones,
// of which no time is known, are left out.
std::vector<MessageTimes> ListImages(const ImageTopic& topic, const BagFile& bag, const char* what,
                                     std::vector<ListedImage>* images,
                                     std::vector<std::string>* warnings) {
  std::vector<MessageTimes> times;
  const int count = bag.NumMessages(topic.name);
  std::string first_error;
  for (int i = 0; i < count; ++i) {
    try {
      const double stamp = bag.Parse(topic.name, i, ParseRosHeader).stamp;
      times.push_back({stamp, bag.ReceiveTime(topic.name, i)});
      images->push_back({0.0, bag.NameOf(topic.name, i), "", i});
    } catch (const std::runtime_error& error) {
      if (first_error.empty()) first_error = error.what();
    }
  }
  const int num_damaged = count - static_cast<int>(times.size());
  if (num_damaged == 0) return times;
  const std::string problem =
      FormatText("%d of %d %s images cannot be read", num_damaged, count, what);
  if (2 * num_damaged > count) throw std::runtime_error(problem + "; the first: " + first_error);
  warnings->push_back(problem + " and are left out; the first: " + first_error);
  return times;
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

// Whether depth is in metres, by the first image that can be read.
bool HasMetres(const SequenceIndex& index) {
  for (const SequenceEntry& entry : index.entries) {
    try {
      const StoredImage image = index.container->ReadDepth(entry.depth_index);
      return image.bytes.empty() && image.pixels.type() == CV_32FC1;
    } catch (const std::runtime_error&) {  // reported when its frame is decoded
    }
  }
  return false;
}

double DepthScaleOf(const BagFile& bag, const std::string& topic,
                    std::vector<std::string>* warnings) {
  std::string problem;
  const std::optional<double> scale = RealSenseDepthScale(bag, topic, &problem);
  if (!problem.empty()) {
    warnings->push_back(problem +
                        "; millimetres are assumed, --set camera.depth_scale=UNITS "
                        "changes that");
  }
  return scale.value_or(kUnitsOfMillimetres);
}

// The program that writes such files and topics.
std::string RecorderOf(const BagFile& bag) {
  for (const BagTopic& topic : bag.topics()) {
    if (IsRealSenseStream(topic.name)) return "RealSense viewer";
  }
  const bool is_ros1 = HasEnding(Lowercase(bag.path()), ".bag");
  return is_ros1 ? "rosbag record, ROS 1" : "ros2 bag record, ROS 2";
}

void ReadGroundTruth(const std::string& path, SequenceIndex* index) {
  const std::string truth =
      (std::filesystem::path(path).parent_path() / (BagName(path) + "-groundtruth.txt")).string();
  if (HasEntry(truth)) ReadGroundTruthFile(truth, WholeStamps::kTimes, index);
}

}  // namespace

SequenceIndex OpenBag(const std::string& given_path, const BagTopics& topics) {
  // Completion in a shell ends the name of a folder with a slash.
  const std::string path = given_path.substr(0, given_path.find_last_not_of('/') + 1);
  const std::shared_ptr<const BagFile> bag = OpenBagFile(path);
  SequenceIndex index;
  index.warnings = bag->warnings();
  index.format = "ros-bag";
  index.recorder = RecorderOf(*bag);
  index.directory = path;
  const CameraInfos infos(*bag, &index.warnings);
  const std::vector<ImageTopic> all = FindImageTopics(*bag, infos, &index.warnings);
  const auto [color, depth] = ChooseTopics(path, all, topics, &index.warnings);
  ImageLists images;
  TopicTimes times;
  times.color = ListImages(color, *bag, "colour", &images.color, &index.warnings);
  times.depth = ListImages(depth, *bag, "depth", &images.depth, &index.warnings);
  StampImages(times, &images, &index.warnings);
  index.container = std::make_shared<BagContainer>(bag, color, depth);
  PairByTime(images, MaxPairDifference(images), &index);
  OrderEntries(&index);
  RequireMostImages(index, path + " (" + color.name + ", " + depth.name + ")");
  index.depth_scale =
      HasMetres(index) ? kUnitsOfMetres : DepthScaleOf(*bag, depth.name, &index.warnings);
  index.calibration = ReadCalibration(*bag, infos, {color, depth}, &index.camera_warnings);
  ChooseCamera(&index);
  ReadGroundTruth(path, &index);
  Log().info("bag {}: colour {}, depth {}", path, color.name, depth.name);
  return index;
}

}  // namespace msc_vo
