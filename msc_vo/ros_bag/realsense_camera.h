// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>
#include <string>

#include "msc_vo/geometry/rigid3.h"
#include "msc_vo/ros_bag/bag_file.h"

namespace msc_vo {

// What recordings of the RealSense viewer, with topics such as
// /device_0/sensor_0/Depth_0/image/data, and of the driver of RealSense cameras for ROS have beside
// images and CameraInfo.

/// Tests whether a topic is one of the RealSense viewer. Coordinate frames mean nothing there.
bool IsRealSenseStream(const std::string& topic);

/// Raw depth units per metre of a depth topic; none if the bag does not say, for which `problem`
/// then gives the reason if it is a topic of the RealSense viewer.
std::optional<double> RealSenseDepthScale(const BagFile& bag, const std::string& depth_topic,
                                          std::string* problem);

/// The transform depth_from_color between the cameras of two topics, metres; none if the bag does
/// not have it, for which `problem` then gives the reason if they are topics of the RealSense
/// viewer.
std::optional<Rigid3> RealSenseDepthFromColor(const BagFile& bag, const std::string& color_topic,
                                              const std::string& depth_topic, std::string* problem);

}  // namespace msc_vo
