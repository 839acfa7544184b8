// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/ros_bag/camera_infos.h"

#include <stdexcept>

#include "msc_vo/ros_bag/ros_image.h"

namespace msc_vo {

namespace {

std::string WithFrame(const std::string& topic, const std::string& frame) {
  return frame.empty() ? topic : topic + " in the frame " + frame;
}

bool FitsTo(const ImageTopic& images, const RosCameraInfo& info) {
  const bool has_size = images.size.width == static_cast<int>(info.width) &&
                        images.size.height == static_cast<int>(info.height);
  return !images.frame.empty() && info.header.frame == images.frame &&
         (has_size || images.size.width == 0);
}

}  // namespace

CameraInfos::CameraInfos(const BagFile& bag, std::vector<std::string>* warnings)
    : bag_path_(bag.path()) {
  for (const BagTopic& topic : bag.topics()) {
    if (topic.type != "sensor_msgs/CameraInfo" || bag.NumMessages(topic.name) == 0) continue;
    try {
      infos_[topic.name] = bag.Parse(topic.name, 0, ParseRosCameraInfo);
    } catch (const std::runtime_error& error) {  // another topic may be good
      warnings->push_back(error.what());
    }
  }
}

std::vector<std::string> CameraInfos::TopicsFor(const ImageTopic& images) const {
  std::vector<std::string> topics;
  const std::string beside = CameraInfoTopicOf(images.name);
  if (infos_.count(beside) > 0) topics.push_back(beside);
  for (const auto& [topic, info] : infos_) {
    if (topic != beside && FitsTo(images, info)) topics.push_back(topic);
  }
  return topics;
}

std::string CameraInfos::DescribeMissing(const ImageTopic& images) const {
  std::string others;
  for (const auto& [topic, info] : infos_) {
    others += (others.empty() ? "; the bag has " : ", ") + WithFrame(topic, info.header.frame);
  }
  return "no CameraInfo belongs to " + WithFrame(images.name, images.frame) + others;
}

std::optional<Calibration> CameraInfos::Find(const ImageTopic& images, std::string* problem) const {
  const bool is_rectified = IsRectified(images);
  std::string problems;
  for (const std::string& topic : TopicsFor(images)) {
    std::string reason;
    std::optional<Calibration> calibration =
        CalibrationFrom(infos_.at(topic), is_rectified, &reason);
    if (calibration) {
      calibration->origin = bag_path_ + ":" + topic + (is_rectified ? " for rectified images" : "");
      return calibration;
    }
    problems += (problems.empty() ? "" : "; ") + topic + " gives no calibration: " + reason;
  }
  *problem = problems.empty() ? DescribeMissing(images) : problems;
  return std::nullopt;
}

}  // namespace msc_vo
