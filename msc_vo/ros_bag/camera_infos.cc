// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/ros_bag/camera_infos.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <set>
#include <stdexcept>
#include <tuple>
#include <utility>

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

bool IsCalibrated(const RosCameraInfo& info) { return info.k[0] != 0.0; }

// Whether two messages describe the same camera.
bool AreEqual(const RosCameraInfo& a, const RosCameraInfo& b) {
  const auto numbers = [](const RosCameraInfo& info) {
    return std::tie(info.width, info.height, info.distortion_model, info.d, info.binning_x,
                    info.binning_y, info.roi_x, info.roi_y, info.roi_width, info.roi_height);
  };
  return numbers(a) == numbers(b) && std::equal(std::begin(a.k), std::end(a.k), std::begin(b.k)) &&
         std::equal(std::begin(a.p), std::end(a.p), std::begin(b.p));
}

// The first CameraInfo of a topic that is calibrated, unless those in the middle and at the end
// agree on another camera. `warnings` gets one if they differ or are damaged. Throws
// std::runtime_error if all messages are damaged.
RosCameraInfo ReadInfo(const BagFile& bag, const std::string& topic,
                       std::vector<std::string>* warnings) {
  const auto read = [&](int i) { return bag.Parse(topic, i, ParseRosCameraInfo); };
  const int last = bag.NumMessages(topic) - 1;
  int first = -1;
  std::optional<RosCameraInfo> found;
  std::string error_before;
  while ((!found || !IsCalibrated(*found)) && first < last) {
    try {
      found = read(++first);
    } catch (const std::runtime_error& error) {
      if (error_before.empty()) error_before = error.what();
    }
  }
  if (!found) throw std::runtime_error(error_before);
  if (!error_before.empty()) warnings->push_back(error_before);
  const RosCameraInfo& info = *found;
  std::vector<std::pair<int, RosCameraInfo>> others;
  for (const int i : std::set<int>{(first + last) / 2, last}) {
    try {
      const RosCameraInfo later = read(i);
      if (IsCalibrated(later) && !AreEqual(later, info)) others.emplace_back(i, later);
    } catch (const std::runtime_error& error) {
      warnings->push_back(error.what());
    }
  }
  if (others.empty()) return info;
  const bool is_later = others.size() == 2 && AreEqual(others[0].second, others[1].second);
  const std::string names[] = {bag.NameOf(topic, first), bag.NameOf(topic, others.back().first)};
  warnings->push_back(names[!is_later] + " describes another camera than " + names[is_later] +
                      ", which is used: poses of images by the other one are wrong");
  return is_later ? others.back().second : info;
}

}  // namespace

CameraInfos::CameraInfos(const BagFile& bag, std::vector<std::string>* warnings)
    : bag_path_(bag.path()) {
  for (const BagTopic& topic : bag.topics()) {
    if (topic.type != "sensor_msgs/CameraInfo" || bag.NumMessages(topic.name) == 0) continue;
    try {
      infos_[topic.name] = ReadInfo(bag, topic.name, warnings);
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
