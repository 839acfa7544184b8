// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/ros_bag/ros_message.h"

#include <stdexcept>

#include "msc_vo/datasets/calibration.h"
#include "msc_vo/ros_bag/ros_fields.h"
#include "msc_vo/text/format_text.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace {

std::unique_ptr<RosFields> OpenFields(std::string_view bytes, RosSerialization serialization) {
  return serialization == RosSerialization::kCdr ? OpenCdrFields(bytes) : OpenRos1Fields(bytes);
}

}  // namespace

double SecondsOf(uint32_t seconds, uint32_t nanoseconds) {
  // A sum in double precision would round twice.
  return *ParseNumber(FormatText("%u.%09u", seconds, nanoseconds));
}

double SecondsOf(int64_t nanoseconds) {
  constexpr int64_t kSecond = 1000000000;
  if (nanoseconds < 0 || nanoseconds / kSecond > UINT32_MAX) return 0.0;
  return SecondsOf(static_cast<uint32_t>(nanoseconds / kSecond),
                   static_cast<uint32_t>(nanoseconds % kSecond));
}

RosHeader ParseRosHeader(std::string_view bytes, RosSerialization serialization) {
  return OpenFields(bytes, serialization)->ReadHeader();
}

RosImage ParseRosImage(std::string_view bytes, RosSerialization serialization) {
  const auto fields = OpenFields(bytes, serialization);
  RosImage image;
  image.header = fields->ReadHeader();
  image.height = fields->ReadWord();
  image.width = fields->ReadWord();
  image.encoding = fields->ReadString();
  image.is_big_endian = fields->ReadByte() != 0;
  image.step = fields->ReadWord();
  image.data = fields->ReadBytes();
  return image;
}

RosCompressedImage ParseRosCompressedImage(std::string_view bytes, RosSerialization serialization) {
  const auto fields = OpenFields(bytes, serialization);
  RosCompressedImage image;
  image.header = fields->ReadHeader();
  image.format = fields->ReadString();
  image.data = fields->ReadBytes();
  return image;
}

RosCameraInfo ParseRosCameraInfo(std::string_view bytes, RosSerialization serialization) {
  const auto fields = OpenFields(bytes, serialization);
  RosCameraInfo info;
  info.header = fields->ReadHeader();
  info.height = fields->ReadWord();
  info.width = fields->ReadWord();
  info.distortion_model = fields->ReadString();
  const uint32_t count = fields->ReadWord();
  constexpr uint32_t kMaxCoefficients = 14;  // of all models of ROS
  if (count > kMaxCoefficients) throw std::runtime_error("the message is no CameraInfo");
  info.d.resize(count);
  fields->ReadDoubles(info.d.data(), count);
  fields->ReadDoubles(info.k, 9);
  fields->ReadDoubles(info.r, 9);
  fields->ReadDoubles(info.p, 12);
  if (fields->IsAtEnd()) return info;  // some writers leave out the rest
  info.binning_x = fields->ReadWord();
  info.binning_y = fields->ReadWord();
  info.roi_x = fields->ReadWord();
  info.roi_y = fields->ReadWord();
  info.roi_height = fields->ReadWord();
  info.roi_width = fields->ReadWord();
  return info;
}

float ParseRosFloat(std::string_view bytes, RosSerialization serialization) {
  return OpenFields(bytes, serialization)->ReadFloat();
}

Rigid3 ParseRosTransform(std::string_view bytes, RosSerialization serialization) {
  const auto fields = OpenFields(bytes, serialization);
  Eigen::Vector3d translation;
  fields->ReadDoubles(translation.data(), 3);
  std::vector<double> xyzw(4);
  fields->ReadDoubles(xyzw.data(), 4);
  const std::optional<Eigen::Quaterniond> rotation = NormalizedQuaternion(xyzw);
  if (!rotation || !translation.allFinite())
    throw std::runtime_error("the message is no transform");
  return {*rotation, translation};
}

}  // namespace msc_vo
