// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/ros_bag/realsense_camera.h"

#include <cmath>
#include <vector>

#include "msc_vo/ros_bag/ros_message.h"
#include "msc_vo/text/ending.h"
#include "msc_vo/text/format_text.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace {

// The elements of a topic: device_0, sensor_0, Depth_0, image, data. Empty if it is none of the
// RealSense viewer.
std::vector<std::string> StreamOf(const std::string& topic) {
  std::vector<std::string> elements;
  for (size_t at = 0; at < topic.size();) {
    const size_t end = std::min(topic.find('/', at + 1), topic.size());
    elements.push_back(topic.substr(at + 1, end - at - 1));
    at = end;
  }
  const bool is_stream = elements.size() == 5 && elements[0].rfind("device_", 0) == 0 &&
                         elements[1].rfind("sensor_", 0) == 0 && elements[3] == "image" &&
                         elements[4] == "data";
  return is_stream ? elements : std::vector<std::string>();
}

// The transform from the reference stream of the device to a stream.
std::optional<Rigid3> StreamFromReference(const BagFile& bag,
                                          const std::vector<std::string>& stream) {
  const std::string prefix = "/" + stream[0] + "/" + stream[1] + "/" + stream[2] + "/tf/";
  for (const BagTopic& topic : bag.topics()) {
    if (topic.name.rfind(prefix, 0) != 0 || bag.NumMessages(topic.name) == 0) continue;
    return bag.Parse(topic.name, 0, ParseRosTransform);
  }
  return std::nullopt;
}

// The transform that the driver for ROS publishes as /camera/extrinsics/depth_to_color, beside
// /camera/depth/... and /camera/color/...
std::optional<Rigid3> DriverDepthFromColor(const BagFile& bag, const std::string& color_topic,
                                           const std::string& depth_topic) {
  const size_t end = depth_topic.find("/depth/");
  if (end == std::string::npos) return std::nullopt;
  const std::string camera = depth_topic.substr(0, end);
  const std::string name = camera + "/extrinsics/depth_to_color";
  if (color_topic.rfind(camera + "/color/", 0) != 0 || !bag.HasMessages(name)) return std::nullopt;
  if (!HasEnding(bag.FindTopic(name)->type, "/Extrinsics")) return std::nullopt;
  return bag.Parse(name, 0, ParseRealSenseExtrinsics).Inverse();
}

}  // namespace

bool IsRealSenseStream(const std::string& topic) { return !StreamOf(topic).empty(); }

std::optional<double> RealSenseDepthScale(const BagFile& bag, const std::string& depth_topic,
                                          std::string* problem) {
  const std::vector<std::string> stream = StreamOf(depth_topic);
  if (stream.empty()) return std::nullopt;
  const std::string options = "/" + stream[0] + "/" + stream[1] + "/option/";
  for (const char* option : {"Depth_Units/value", "Depth Units/value"}) {
    if (!bag.HasMessages(options + option)) continue;
    const float units = bag.Parse(options + option, 0, ParseRosFloat);
    // Seven digits are what single precision tells apart: 0.001f is 0.001, not 0.00100000005.
    const std::optional<double> decimal = ParseNumber(FormatText("%.7g", units));
    if (decimal && *decimal > 0.0 && std::isfinite(*decimal)) return 1.0 / *decimal;
  }
  *problem = "the recording does not give the unit of depth (" + options + "Depth_Units/value)";
  return std::nullopt;
}

std::optional<Rigid3> RealSenseDepthFromColor(const BagFile& bag, const std::string& color_topic,
                                              const std::string& depth_topic,
                                              std::string* problem) {
  const std::vector<std::string> color = StreamOf(color_topic), depth = StreamOf(depth_topic);
  if (color.empty() || depth.empty()) return DriverDepthFromColor(bag, color_topic, depth_topic);
  const std::optional<Rigid3> color_from_reference = StreamFromReference(bag, color);
  const std::optional<Rigid3> depth_from_reference = StreamFromReference(bag, depth);
  if (!color_from_reference || !depth_from_reference) {
    *problem = "the bag has no transform (tf) of " +
               std::string(color_from_reference ? depth_topic : color_topic);
    return std::nullopt;
  }
  return *depth_from_reference * color_from_reference->Inverse();
}

}  // namespace msc_vo
