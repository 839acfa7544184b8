// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Messages of ROS bags: images, compressed images, calibrations and others. The first byte chooses
// the type and whether the message is of ROS 1 or 2.

#include <cmath>

#include "tests/fuzz/input_folder.h"
#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>

#include "msc_vo/ros_bag/frame_tree.h"
#include "msc_vo/ros_bag/ros_image.h"
#include "msc_vo/ros_bag/rvl.h"
#include "msc_vo/ros_bag/topic_choice.h"

namespace msc_vo {
namespace {

void ReadImage(std::string_view bytes, RosSerialization serialization) {
  const RosImage image = ParseRosImage(bytes, serialization);
  const StoredImage stored = ConvertRosImage(image);
  Require(stored.pixels.rows == static_cast<int>(image.height) &&
              stored.pixels.cols == static_cast<int>(image.width),
          "an image of the size in the message");
}

void ReadCompressedImage(std::string_view bytes, RosSerialization serialization) {
  const RosCompressedImage image = ParseRosCompressedImage(bytes, serialization);
  KindOfCompressed(image);
  ConvertRosImage(image);
}

void ReadCameraInfo(std::string_view bytes, RosSerialization serialization) {
  const RosCameraInfo info = ParseRosCameraInfo(bytes, serialization);
  for (const bool is_rectified : {false, true}) {
    std::string problem;
    const std::optional<Calibration> calibration = CalibrationFrom(info, is_rectified, &problem);
    Require(calibration || !problem.empty(), "a reason for no calibration");
  }
}

void ReadFrameTransforms(std::string_view bytes, RosSerialization serialization) {
  FrameTree tree;
  const std::vector<RosFrameTransform> transforms = ParseRosFrameTransforms(bytes, serialization);
  for (const RosFrameTransform& transform : transforms) {
    Require(transform.parent_from_child.params.allFinite(), "a finite transform");
    tree.Add(transform);
  }
  if (!transforms.empty()) tree.Find(transforms.front().child, transforms.back().child);
}

}  // namespace
}  // namespace msc_vo

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace msc_vo;
  static const auto level = cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  static_cast<void>(level);
  if (size == 0) return 0;
  const std::string_view bytes = AsText(data + 1, size - 1);
  // The caller names file, topic and message.
  Accepts("", [&] {
    const auto serialization = data[0] & 8 ? RosSerialization::kCdr : RosSerialization::kRos1;
    switch (data[0] % 8) {
      case 0:
        return ReadImage(bytes, serialization);
      case 1:
        return ReadCompressedImage(bytes, serialization);
      case 2:
        return ReadCameraInfo(bytes, serialization);
      case 3:
        Require(std::isfinite(ParseRosHeader(bytes, serialization).stamp), "a finite stamp");
        CameraInfoTopicOf(std::string(bytes));
        return;
      case 4:
        Require(ParseRosTransform(bytes, serialization).translation().allFinite(),
                "a finite translation");
        return;
      case 6:
        return ReadFrameTransforms(bytes, serialization);
      case 7:
        Require(ParseRealSenseExtrinsics(bytes, serialization).params.allFinite(),
                "a finite transform");
        return;
      default:
        DecodeRvl(bytes);
    }
  });
  return 0;
}
