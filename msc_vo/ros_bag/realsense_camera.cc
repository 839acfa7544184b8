// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/ros_bag/realsense_camera.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "msc_vo/datasets/calibration.h"
#include "msc_vo/ros_bag/ros_image.h"
#include "msc_vo/ros_bag/topic_choice.h"
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

std::optional<Calibration> StreamCalibration(const BagFile& bag, const std::string& topic,
                                             std::string* problem) {
  const std::string name = CameraInfoTopicOf(topic);
  if (bag.FindTopic(name) == nullptr || bag.NumMessages(name) == 0) {
    *problem = "the bag has no " + name;
    return std::nullopt;
  }
  return CalibrationFrom(bag.Parse(name, 0, ParseRosCameraInfo), false, problem);
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

bool IsSameView(const PinholeCamera& a, const PinholeCamera& b, const Rigid3& b_from_a) {
  constexpr double kPixels = 0.01, kMetres = 1e-6;  // of numbers that were written as text
  const double difference = std::max(
      {std::abs(a.fx - b.fx), std::abs(a.fy - b.fy), std::abs(a.cx - b.cx), std::abs(a.cy - b.cy)});
  return a.width == b.width && a.height == b.height && difference < kPixels &&
         b_from_a.translation().norm() < kMetres &&
         b_from_a.rotation().angularDistance(Eigen::Quaterniond::Identity()) < kMetres;
}

}  // namespace

std::optional<double> RealSenseDepthScale(const BagFile& bag, const std::string& depth_topic,
                                          std::string* problem) {
  const std::vector<std::string> stream = StreamOf(depth_topic);
  if (stream.empty()) return std::nullopt;
  const std::string options = "/" + stream[0] + "/" + stream[1] + "/option/";
  for (const char* option : {"Depth_Units/value", "Depth Units/value"}) {
    const BagTopic* topic = bag.FindTopic(options + option);
    if (topic == nullptr || bag.NumMessages(topic->name) == 0) continue;
    const float units = bag.Parse(topic->name, 0, ParseRosFloat);
    // Seven digits are what single precision tells apart: 0.001f is 0.001, not 0.00100000005.
    const std::optional<double> decimal = ParseNumber(FormatText("%.7g", units));
    if (decimal && *decimal > 0.0 && std::isfinite(*decimal)) return 1.0 / *decimal;
  }
  *problem = "the recording does not give the unit of depth (" + options + "Depth_Units/value)";
  return std::nullopt;
}

std::optional<DepthCamera> RealSenseDepthCamera(const BagFile& bag, const std::string& color_topic,
                                                const std::string& depth_topic,
                                                std::string* problem) {
  const std::vector<std::string> color = StreamOf(color_topic), depth = StreamOf(depth_topic);
  if (color.empty() || depth.empty()) return std::nullopt;
  const std::optional<Calibration> color_camera = StreamCalibration(bag, color_topic, problem);
  const std::optional<Calibration> depth_camera = StreamCalibration(bag, depth_topic, problem);
  if (!color_camera || !depth_camera) return std::nullopt;
  const std::optional<Rigid3> color_from_reference = StreamFromReference(bag, color);
  const std::optional<Rigid3> depth_from_reference = StreamFromReference(bag, depth);
  if (!color_from_reference || !depth_from_reference) {
    *problem = "the bag has no transform (tf) of " +
               std::string(color_from_reference ? depth_topic : color_topic);
    return std::nullopt;
  }
  DepthCamera camera;
  camera.camera = depth_camera->Recorded();
  camera.distortion = depth_camera->distortion;
  camera.distortion.recorded.reset();
  camera.depth_from_color = *depth_from_reference * color_from_reference->Inverse();
  if (IsSameView(color_camera->Recorded(), camera.camera, camera.depth_from_color)) {
    return std::nullopt;
  }
  return camera;
}

}  // namespace msc_vo
