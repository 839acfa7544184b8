// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include "msc_vo/image_files/image_file.h"
#include "msc_vo/ros_bag/ros_image.h"

namespace msc_vo {

/// A topic with images.
struct ImageTopic {
  std::string name;
  RosImageKind kind = RosImageKind::kOther;
  bool is_compressed = false;
  std::string encoding = {};   ///< of the first image, for messages
  std::string frame = {};      ///< coordinate frame of the first image; empty: unknown
  ImageSize size = {};         ///< of the first image; zero: unknown
  bool is_calibrated = false;  ///< the bag has a CameraInfo of these images with intrinsics
};

/// Topics of colour and of depth images.
struct TopicPair {
  ImageTopic color;
  ImageTopic depth;
};

/// Returns the words of a name in lower case, without numbers at their end:
/// "/cam_1/irImage_rect" -> cam, ir, image, rect.
std::vector<std::string> TopicWords(const std::string& name);

/// Tests whether images may be depth or those of a grey or thermal camera with 16 bits: they are
/// mono16, in which the RealSense viewer has recorded depth, and are not named as depth.
bool MayBeGray16(const ImageTopic& topic);

/// Returns the topics that may hold depth images, without those that are named as infrared.
/// Those that may be grey are returned only if there are no others.
std::vector<ImageTopic> DepthTopics(std::vector<ImageTopic> topics);

/// Returns the topics that may hold colour images, without those that are named as infrared.
std::vector<ImageTopic> ColorTopics(std::vector<ImageTopic> topics);

/// Returns the best pair of topics, neither of which may be empty. In this order, it prefers colour
/// that is not named as depth, depth in the coordinate frame of colour, then depth that is named as
/// registered, calibrated colour, colour to grey, names that have most in common, and raw to
/// compressed images. Of pairs that are equally good, the first one is taken.
TopicPair BestPair(const std::vector<ImageTopic>& colors, const std::vector<ImageTopic>& depths);

/// Describes what the rank of a topic follows from: "/camera/ir/image (grey, infrared)".
std::string DescribeTopic(const ImageTopic& topic);

/// Tests whether the depth images of a topic are named as registered to colour.
bool IsRegistered(const ImageTopic& topic);

/// Tests whether images of both topics are in one coordinate frame, which must be known.
bool HaveSameFrame(const ImageTopic& a, const ImageTopic& b);

/// Tests whether depth images are registered to colour by the name of their topic or, as REP 118 of
/// ROS has it, because they are in the coordinate frame of the colour images.
bool AreRegistered(const ImageTopic& depth, const ImageTopic& color);

/// Tests whether the images of a topic are named as free of lens distortion.
bool IsRectified(const ImageTopic& topic);

/// Returns the topic of the CameraInfo that belongs to a topic with images:
/// "/camera/rgb/image_color/compressed" -> "/camera/rgb/camera_info", and, of the RealSense viewer,
/// "/device_0/sensor_1/Color_0/image/data" -> "/device_0/sensor_1/Color_0/info/camera_info".
std::string CameraInfoTopicOf(const std::string& image_topic);

}  // namespace msc_vo
