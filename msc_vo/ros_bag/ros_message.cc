// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/ros_bag/ros_message.h"

#include <optional>
#include <stdexcept>
#include <utility>

#include "msc_vo/datasets/calibration.h"
#include "msc_vo/ros_bag/ros_fields.h"
#include "msc_vo/text/format_text.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace {

std::unique_ptr<RosFields> OpenFields(std::string_view bytes, RosSerialization serialization) {
  return serialization == RosSerialization::kCdr ? OpenCdrFields(bytes) : OpenRos1Fields(bytes);
}

// None if the rotation has no unit length.
std::optional<Rigid3> ReadTransform(RosFields* fields) {
  Eigen::Vector3d translation;
  fields->ReadDoubles(translation.data(), 3);
  std::vector<double> xyzw(4);
  fields->ReadDoubles(xyzw.data(), 4);
  const std::optional<Eigen::Quaterniond> rotation = NormalizedQuaternion(xyzw);
  if (!rotation || !translation.allFinite()) return std::nullopt;
  return Rigid3(*rotation, translation);
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
  const std::optional<Rigid3> transform = ReadTransform(OpenFields(bytes, serialization).get());
  if (!transform) throw std::runtime_error("the message is no transform");
  return *transform;
}

std::vector<RosFrameTransform> ParseRosFrameTransforms(std::string_view bytes,
                                                       RosSerialization serialization) {
  const auto fields = OpenFields(bytes, serialization);
  std::vector<RosFrameTransform> transforms;
  const uint32_t count = fields->ReadWord();
  for (uint32_t i = 0; i < count; ++i) {
    std::string parent = fields->ReadHeader().frame;
    std::string child = fields->ReadFrame();
    const std::optional<Rigid3> transform = ReadTransform(fields.get());
    if (transform) transforms.push_back({std::move(parent), std::move(child), *transform});
  }
  return transforms;
}

Rigid3 ParseRealSenseExtrinsics(std::string_view bytes, RosSerialization serialization) {
  constexpr size_t kMaxBytesWithoutHeader = 4 + 12 * sizeof(double);
  constexpr double kMaxError = 1e-3;  // of numbers in single precision
  const auto fields = OpenFields(bytes, serialization);
  if (bytes.size() > kMaxBytesWithoutHeader) fields->ReadHeader();
  Eigen::Matrix3d rotation;  // column by column
  fields->ReadDoubles(rotation.data(), 9);
  Eigen::Vector3d translation;
  fields->ReadDoubles(translation.data(), 3);
  const bool is_rotation = (rotation * rotation.transpose()).isIdentity(kMaxError) &&
                           rotation.determinant() > 0.0 && translation.allFinite();
  if (!is_rotation) throw std::runtime_error("the message is no transform");
  return {Eigen::Quaterniond(rotation).normalized(), translation};
}

}  // namespace msc_vo
