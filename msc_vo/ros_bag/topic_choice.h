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
};

/// Returns the topics that may hold colour images, or depth images, the best first: depth that is
/// registered to colour, colour before grey, raw before compressed. Infrared images are no colour
/// images. Topics that are equally good stay in their order.
std::vector<ImageTopic> RankColorTopics(std::vector<ImageTopic> topics);
std::vector<ImageTopic> RankDepthTopics(std::vector<ImageTopic> topics);

/// Returns the topic of the CameraInfo that belongs to a topic with images:
/// "/camera/rgb/image_color/compressed" -> "/camera/rgb/camera_info".
std::string CameraInfoTopicOf(const std::string& image_topic);

}  // namespace msc_vo
