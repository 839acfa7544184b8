// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "msc_vo/geometry/rigid3.h"

namespace msc_vo {

// Messages of ROS that RGB-D cameras publish, deserialised from their bytes. The parsers throw
// std::runtime_error if the bytes end too early, or if they are CDR and msc_vo was built without
// Fast CDR. Views point into the bytes.

/// How the bytes of a message are to be read.
enum class RosSerialization {
  kRos1,
  kCdr,  ///< of ROS 2, in either order of bytes
};

/// Returns a time as the double nearest to its decimal number of seconds, as in a text file.
double SecondsOf(uint32_t seconds, uint32_t nanoseconds);
/// The same for nanoseconds since 1970; 0 for times before and beyond 2106.
double SecondsOf(int64_t nanoseconds);

/// std_msgs/Header.
struct RosHeader {
  double stamp = 0.0;  ///< seconds; the double nearest to the decimal number of the stamp
  std::string frame;   ///< name of the coordinate frame, without a slash in front
};

/// sensor_msgs/Image.
struct RosImage {
  RosHeader header;
  uint32_t height = 0;
  uint32_t width = 0;
  std::string encoding;
  bool is_big_endian = false;
  uint32_t step = 0;  ///< bytes per row
  std::string_view data;
};

/// sensor_msgs/CompressedImage.
struct RosCompressedImage {
  RosHeader header;
  std::string format;  ///< "bgr8; jpeg compressed bgr8", "16UC1; compressedDepth"
  std::string_view data;
};

/// sensor_msgs/CameraInfo. The intrinsics are those of full images; the published ones show the
/// region and have a pixel for each `binning_x` x `binning_y` pixels of it.
struct RosCameraInfo {
  RosHeader header;
  uint32_t height = 0;
  uint32_t width = 0;
  std::string distortion_model;
  std::vector<double> d;
  double k[9] = {};
  double r[9] = {};
  double p[12] = {};
  uint32_t binning_x = 0;  ///< 0 as 1
  uint32_t binning_y = 0;
  uint32_t roi_x = 0;
  uint32_t roi_y = 0;
  uint32_t roi_height = 0;  ///< 0: all rows
  uint32_t roi_width = 0;   ///< 0: all columns
};

/// geometry_msgs/TransformStamped. The names of the frames have no slash in front.
struct RosFrameTransform {
  std::string parent;
  std::string child;
  Rigid3 parent_from_child;  ///< metres
};

/// All messages with images begin with a header.
RosHeader ParseRosHeader(std::string_view bytes, RosSerialization serialization);
RosImage ParseRosImage(std::string_view bytes, RosSerialization serialization);
RosCompressedImage ParseRosCompressedImage(std::string_view bytes, RosSerialization serialization);
RosCameraInfo ParseRosCameraInfo(std::string_view bytes, RosSerialization serialization);
/// std_msgs/Float32.
float ParseRosFloat(std::string_view bytes, RosSerialization serialization);
/// geometry_msgs/Transform; translation in metres. Throws std::runtime_error if the rotation has no
/// unit length.
Rigid3 ParseRosTransform(std::string_view bytes, RosSerialization serialization);
/// tf2_msgs/TFMessage and tf/tfMessage. Transforms whose rotation has no unit length are left out.
std::vector<RosFrameTransform> ParseRosFrameTransforms(std::string_view bytes,
                                                       RosSerialization serialization);
/// realsense2_camera_msgs/Extrinsics, with or without a header: b_from_a of the topic a_to_b,
/// metres. Throws std::runtime_error if the rotation is none.
Rigid3 ParseRealSenseExtrinsics(std::string_view bytes, RosSerialization serialization);

}  // namespace msc_vo
