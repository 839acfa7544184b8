// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Messages of ROS bags: images, compressed images and calibrations. The first byte chooses the
// type.

#include <cmath>

#include "tests/fuzz/input_folder.h"
#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>

#include "msc_vo/ros_bag/ros_image.h"
#include "msc_vo/ros_bag/topic_choice.h"

namespace msc_vo {
namespace {

void ReadImage(std::string_view bytes) {
  const RosImage image = ParseRosImage(bytes);
  const StoredImage stored = ConvertRosImage(image);
  Require(stored.pixels.rows == static_cast<int>(image.height) &&
              stored.pixels.cols == static_cast<int>(image.width),
          "an image of the size in the message");
}

void ReadCompressedImage(std::string_view bytes) {
  const RosCompressedImage image = ParseRosCompressedImage(bytes);
  KindOfFormat(image.format);
  ConvertRosImage(image);
}

void ReadCameraInfo(std::string_view bytes) {
  const RosCameraInfo info = ParseRosCameraInfo(bytes);
  for (const bool is_rectified : {false, true}) {
    std::string problem;
    const std::optional<Calibration> calibration = CalibrationFrom(info, is_rectified, &problem);
    Require(calibration || !problem.empty(), "a reason for no calibration");
  }
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
    switch (data[0] % 4) {
      case 0:
        return ReadImage(bytes);
      case 1:
        return ReadCompressedImage(bytes);
      case 2:
        return ReadCameraInfo(bytes);
      default:
        Require(std::isfinite(ParseRosHeader(bytes).stamp), "a finite stamp");
        CameraInfoTopicOf(std::string(bytes));
    }
  });
  return 0;
}
