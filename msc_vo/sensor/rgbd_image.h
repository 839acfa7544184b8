// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <optional>

#include <opencv2/core.hpp>

#include "msc_vo/geometry/camera_velocity.h"

namespace msc_vo {

/// A decoded, registered RGB-D image: the depth of colour pixel (x, y) is depth(y, x).
struct RgbdImage {
  /// Position in the sequence, from 0. Names the frame in results, messages and the log; nothing
  /// requires it to be unique or to ascend.
  int64_t id = 0;
  double timestamp = 0.0;  ///< seconds, of the colour image
  cv::Mat gray;            ///< CV_8UC1
  cv::Mat depth;           ///< CV_32FC1, metres along the optical axis; 0: no measurement
  /// Time at which the depth image was recorded relative to that of the colour image, seconds.
  double depth_delay = 0.0;
  /// Velocity of the camera by which `depth` was moved to the time of the colour image, if it was.
  std::optional<CameraVelocity> depth_velocity = {};
  /// The depth image as the sensor recorded it, if `depth` was registered to the colour image or
  /// aligned to its time, which changes its noise; otherwise empty.
  cv::Mat recorded_depth = {};
  /// CV_8UC1 of the size of `gray`: pixels that are not zero are left out, as those of the robot's
  /// own arm or of people. No feature is detected on them or so near that its descriptor would see
  /// them, and their depth is not used. Empty: all pixels are used.
  cv::Mat mask = {};
};

}  // namespace msc_vo
