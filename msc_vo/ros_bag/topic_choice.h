// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include "msc_vo/ros_bag/ros_image.h"

namespace msc_vo {

/// A topic with images.
struct ImageTopic {
  std::string name;
  RosImageKind kind = RosImageKind::kOther;
  bool is_compressed = false;
  std::string encoding = {};  ///< of the first image, for messages
  std::string frame = {};     ///< coordinate frame of the first image
};

/// Returns the words of a name in lower case, without numbers at their end:
/// "/cam_1/irImage_rect" -> cam, ir, image, rect.
std::vector<std::string> TopicWords(const std::string& name);

/// Returns the topics that may hold depth images, the best first: named as registered to colour,
/// raw before compressed. Topics that are equally good stay in their order.
std::vector<ImageTopic> RankDepthTopics(std::vector<ImageTopic> topics);

/// Returns the topics that may hold colour images, the best first: colour before grey, not named as
/// depth, then those whose names have most in common with that of the depth topic, raw before
/// compressed. Topics that are named as infrared are left out.
std::vector<ImageTopic> RankColorTopics(std::vector<ImageTopic> topics,
                                        const std::string& depth_topic);

/// Describes what the rank of a topic follows from: "/camera/ir/image (grey, infrared)".
std::string DescribeTopic(const ImageTopic& topic);

/// Tests whether the depth images of a topic are named as registered to colour.
bool IsRegistered(const ImageTopic& topic);

/// Tests whether the images of a topic are named as free of lens distortion.
bool IsRectified(const ImageTopic& topic);

/// Returns the topic of the CameraInfo that belongs to a topic with images:
/// "/camera/rgb/image_color/compressed" -> "/camera/rgb/camera_info", and, of the RealSense viewer,
/// "/device_0/sensor_1/Color_0/image/data" -> "/device_0/sensor_1/Color_0/info/camera_info".
std::string CameraInfoTopicOf(const std::string& image_topic);

}  // namespace msc_vo
