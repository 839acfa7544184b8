// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/ros_bag/bag_sequence.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "msc_vo/datasets/camera_preset.h"
#include "msc_vo/datasets/image_pairing.h"
#include "msc_vo/datasets/image_size_fit.h"
#include "msc_vo/datasets/tum_folder.h"
#include "msc_vo/logging/logger.h"
#include "msc_vo/ros_bag/bag_file.h"
#include "msc_vo/ros_bag/bag_stamps.h"
#include "msc_vo/ros_bag/realsense_camera.h"
#include "msc_vo/ros_bag/topic_choice.h"
#include "msc_vo/text/ending.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/text_file.h"

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

// A topic with images and what its first message holds.
ImageTopic ReadTopic(const BagFile& bag, const BagTopic& topic) {
  return bag.Parse(topic.name, 0, [&](std::string_view bytes, RosSerialization form) -> ImageTopic {
    if (topic.type == kCompressedType) {
      const RosCompressedImage image = ParseRosCompressedImage(bytes, form);
      return {topic.name, KindOfFormat(image.format), true, image.format, image.header.frame};
    }
    const RosImage image = ParseRosImage(bytes, form);
    return {topic.name, KindOfEncoding(image.encoding), false, image.encoding, image.header.frame};
  });
}

// All topics with images and what their first message holds.
std::vector<ImageTopic> FindImageTopics(const BagFile& bag, std::vector<std::string>* warnings) {
  std::vector<ImageTopic> topics;
  for (const BagTopic& topic : bag.topics()) {
    const bool is_compressed = topic.type == kCompressedType;
    if (topic.type != kImageType && !is_compressed) continue;
    if (bag.NumMessages(topic.name) == 0) continue;
    try {
      topics.push_back(ReadTopic(bag, topic));
    } catch (const std::runtime_error& error) {  // another topic may be good
      warnings->push_back(error.what());
      topics.push_back({topic.name, RosImageKind::kOther, is_compressed, "", ""});
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

// The topic that the user names, or else the best one. Says which other topics would fit.
ImageTopic ChooseTopic(const std::string& path, const std::vector<ImageTopic>& all,
                       const std::vector<ImageTopic>& ranked, const std::string& name,
                       const std::string& what, std::vector<std::string>* warnings) {
  const std::string option = what == "depth" ? "--depth-topic" : "--color-topic";
  if (!name.empty()) {
    for (const ImageTopic& topic : all) {
      if (topic.name == name) return topic;
    }
    throw std::runtime_error(path + ": no images in the topic " + name + " (" + option +
                             "); topics with images: " + Describe(all));
  }
  if (ranked.empty()) {
    throw std::runtime_error(path + ": no topic with " + what + " images found; topics with " +
                             "images: " + Describe(all) +
                             (all.empty() ? "" : "; " + option + " names one"));
  }
  const ImageTopic& best = ranked.front();
  if (ranked.size() > 1) {
    warnings->push_back(what + " images: " + DescribeTopic(best) + " is used, not " +
                        Describe(ranked, best.name) + "; " + option + " names another one");
  }
  return best;
}

// Names all messages of a topic and reads their times, in the order of recording.
std::vector<MessageTimes> ListImages(const ImageTopic& topic, const BagFile& bag,
                                     std::vector<ListedImage>* images) {
  std::vector<MessageTimes> times;
  const int count = bag.NumMessages(topic.name);
  for (int i = 0; i < count; ++i) {
    images->push_back({0.0, bag.NameOf(topic.name, i), "", i});
    times.push_back(
        {bag.Parse(topic.name, i, ParseRosHeader).stamp, bag.ReceiveTime(topic.name, i)});
  }
  return times;
}

// Tests whether depth images are registered to colour by the name of their topic or, as REP 118 of
// ROS has it, because they are in the coordinate frame of the colour images.
bool AreRegistered(const ImageTopic& depth, const ImageTopic& color) {
  return IsRegistered(depth) || (!depth.frame.empty() && depth.frame == color.frame);
}

// The camera of depth images that are not registered, if their CameraInfo is another one than that
// of the colour images; none otherwise. Its place is not in the CameraInfo.
std::optional<DepthCamera> SeparateDepthCamera(const BagFile& bag, const ImageTopic& depth,
                                               const Calibration& color) {
  // Relative to the focal length: 3 pixels at the border of an image of 640.
  constexpr double kTolerance = 0.01;
  const std::string name = CameraInfoTopicOf(depth.name);
  const BagTopic* info = bag.FindTopic(name);
  if (info == nullptr || info->type != kCameraInfoType || bag.NumMessages(name) == 0) {
    return std::nullopt;
  }
  std::string problem;
  const std::optional<Calibration> own =
      CalibrationFrom(bag.Parse(name, 0, ParseRosCameraInfo), IsRectified(depth), &problem);
  if (!own) return std::nullopt;
  const PinholeCamera& a = color.Recorded();
  const PinholeCamera b = ScaledCamera(own->Recorded(), {a.width, a.height});
  const double difference = std::max(
      {std::abs(a.fx - b.fx), std::abs(a.fy - b.fy), std::abs(a.cx - b.cx), std::abs(a.cy - b.cy)});
  if (difference <= kTolerance * std::abs(a.fx)) return std::nullopt;
  DepthCamera camera;
  camera.camera = own->Recorded();
  camera.distortion = own->distortion;
  camera.distortion.recorded.reset();
  return camera;
}

void ReadCamera(const BagFile& bag, const ImageTopic& color, const ImageTopic& depth,
                SequenceIndex* index) {
  for (const ImageTopic* topic : {&color, &depth}) {
    const std::string name = CameraInfoTopicOf(topic->name);
    const BagTopic* info = bag.FindTopic(name);
    if (info == nullptr || info->type != kCameraInfoType || bag.NumMessages(name) == 0) continue;
    std::string problem;
    index->calibration =
        CalibrationFrom(bag.Parse(name, 0, ParseRosCameraInfo), IsRectified(color), &problem);
    if (index->calibration) {
      index->calibration->origin =
          bag.path() + ":" + name + (IsRectified(color) ? " for rectified images" : "");
      if (topic == &depth && !IsRegistered(depth)) {
        index->warnings.push_back("no CameraInfo belongs to " + color.name + "; " + name +
                                  " of the depth images is used, which is wrong unless these are "
                                  "registered to colour; --camera-file gives the right camera");
      }
      break;
    }
    index->warnings.push_back(name + " gives no calibration: " + problem);
  }
  if (!index->calibration) return;
  std::optional<DepthCamera>& depth_camera = index->calibration->depth_camera;
  std::string problem;
  depth_camera = RealSenseDepthCamera(bag, color.name, depth.name, &problem);
  if (depth_camera) return;
  if (!problem.empty() || !AreRegistered(depth, color)) {
    depth_camera = SeparateDepthCamera(bag, depth, *index->calibration);
  }
  if (depth_camera) {
    index->warnings.push_back(
        CameraInfoTopicOf(depth.name) + " of the depth images is another camera than that of " +
        color.name +
        ", and neither topic nor frame names them as registered; its place is not known" +
        (problem.empty() ? "" : " (" + problem + ")") +
        " and taken for that of the colour camera: record registered depth, or set "
        "camera.depth_camera.translation and rotation");
  } else if (!problem.empty()) {
    index->warnings.push_back(
        "the place of the depth camera beside the colour camera is not known: " + problem);
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
    if (topic.name.rfind("/device_0/sensor_", 0) == 0) return "RealSense viewer";
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
  const std::vector<ImageTopic> all = FindImageTopics(*bag, &index.warnings);
  const ImageTopic depth =
      ChooseTopic(path, all, RankDepthTopics(all), topics.depth, "depth", &index.warnings);
  const ImageTopic color = ChooseTopic(path, all, RankColorTopics(all, depth.name), topics.color,
                                       "colour", &index.warnings);
  ImageLists images;
  TopicTimes times;
  times.color = ListImages(color, *bag, &images.color);
  times.depth = ListImages(depth, *bag, &images.depth);
  StampImages(times, &images, &index.warnings);
  PairByTime(images, MaxPairDifference(images), &index);
  OrderEntries(&index);
  RequireMostImages(index, path + " (" + color.name + ", " + depth.name + ")");
  index.container = std::make_shared<BagContainer>(bag, color, depth);
  const StoredImage first = index.container->ReadDepth(index.entries.front().depth_index);
  const bool is_metres = first.bytes.empty() && first.pixels.type() == CV_32FC1;
  index.depth_scale = is_metres ? kUnitsOfMetres : DepthScaleOf(*bag, depth.name, &index.warnings);
  ReadCamera(*bag, color, depth, &index);
  ChooseCamera(&index);
  ReadGroundTruth(path, &index);
  Log().info("bag {}: colour {}, depth {}", path, color.name, depth.name);
  return index;
}

}  // namespace msc_vo
