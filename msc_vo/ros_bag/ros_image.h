// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>
#include <string>

#include "msc_vo/datasets/calibration.h"
#include "msc_vo/datasets/image_container.h"
#include "msc_vo/ros_bag/ros_message.h"

namespace msc_vo {

/// What a topic with images holds.
enum class RosImageKind { kOther, kGray, kColor, kDepth };

/// Returns the kind of an encoding of sensor_msgs/Image.
RosImageKind KindOfEncoding(const std::string& encoding);
/// Returns the kind of a sensor_msgs/CompressedImage: that of the encoding in its format, if it has
/// one. JPEG images of depth have lost their measurements and are of no kind.
RosImageKind KindOfCompressed(const RosCompressedImage& image);

/// Converts a colour image (8 bits per channel: bgr8, rgb8, bgra8, rgba8, mono8, 8UC1, 8UC3, Bayer
/// patterns, yuv422 and yuv422_yuy2 and their names uyvy and yuyv) or a depth image (16UC1 and
/// mono16 in millimetres, 32FC1 in metres). Throws std::runtime_error if the encoding is another
/// one or the size does not fit the data.
StoredImage ConvertRosImage(const RosImage& image);

/// Returns a compressed image as it is, and a compressed depth image of compressedDepth of
/// image_transport (PNG or RVL) or of floating-point numbers decoded. Throws std::runtime_error if
/// it is damaged.
StoredImage ConvertRosImage(const RosCompressedImage& image);

/// Returns the calibration of a CameraInfo for images as they come from the camera, or, if
/// `is_rectified`, for images without distortion. Nothing if it is not calibrated or its lens model
/// is none of plumb_bob, rational_polynomial and equidistant; `problem` then says why.
std::optional<Calibration> CalibrationFrom(const RosCameraInfo& info, bool is_rectified,
                                           std::string* problem);

}  // namespace msc_vo
