// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>
#include <string>

#include "msc_vo/ros_bag/bag_file.h"
#include "msc_vo/sensor/depth_camera.h"

namespace msc_vo {

// What recordings of the RealSense viewer say of the camera beside the CameraInfo of each stream,
// for topics such as /device_0/sensor_0/Depth_0/image/data.

/// Raw depth units per metre of a depth topic; none if the bag does not say, for which `problem`
/// then gives the reason if it is such a topic.
std::optional<double> RealSenseDepthScale(const BagFile& bag, const std::string& depth_topic,
                                          std::string* problem);

/// The camera of the depth images; none if they are registered to the colour images, or if the bag
/// does not say, for which `problem` then gives the reason. Other bags have neither.
std::optional<DepthCamera> RealSenseDepthCamera(const BagFile& bag, const std::string& color_topic,
                                                const std::string& depth_topic,
                                                std::string* problem);

}  // namespace msc_vo
