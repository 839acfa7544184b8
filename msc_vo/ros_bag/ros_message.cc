// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/ros_bag/ros_message.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "msc_vo/text/format_text.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace {

// Reads the fields of a message in their order. ROS serialises in little-endian order; this code
// runs on little-endian machines only, as the rest of msc_vo.
class Fields {
 public:
  explicit Fields(std::string_view bytes) : bytes_(bytes) {}

  template <typename Number>
  Number Read() {
    Number value;
    std::memcpy(&value, Take(sizeof(value)).data(), sizeof(value));
    return value;
  }
  std::string_view ReadArray() { return Take(Read<uint32_t>()); }
  std::string ReadString() { return std::string(ReadArray()); }
  void ReadNumbers(double* values, size_t count) {
    const std::string_view bytes = Take(count * sizeof(double));
    std::copy(bytes.begin(), bytes.end(), reinterpret_cast<char*>(values));  // also none to null
  }
  RosHeader ReadHeader() {
    Read<uint32_t>();  // sequence number
    const auto seconds = Read<uint32_t>();
    const auto nanoseconds = Read<uint32_t>();
    ReadArray();  // name of the frame
    return {SecondsOf(seconds, nanoseconds)};
  }

 private:
  std::string_view Take(size_t count) {
    if (count > bytes_.size()) throw std::runtime_error("the message ends too early");
    const std::string_view taken = bytes_.substr(0, count);
    bytes_.remove_prefix(count);
    return taken;
  }

  std::string_view bytes_;
};

}  // namespace

double SecondsOf(uint32_t seconds, uint32_t nanoseconds) {
  // A sum in double precision would round twice.
  return *ParseNumber(FormatText("%u.%09u", seconds, nanoseconds));
}

RosHeader ParseRosHeader(std::string_view bytes) { return Fields(bytes).ReadHeader(); }

RosImage ParseRosImage(std::string_view bytes) {
  Fields fields(bytes);
  RosImage image;
  image.header = fields.ReadHeader();
  image.height = fields.Read<uint32_t>();
  image.width = fields.Read<uint32_t>();
  image.encoding = fields.ReadString();
  image.is_big_endian = fields.Read<uint8_t>() != 0;
  image.step = fields.Read<uint32_t>();
  image.data = fields.ReadArray();
  return image;
}

RosCompressedImage ParseRosCompressedImage(std::string_view bytes) {
  Fields fields(bytes);
  RosCompressedImage image;
  image.header = fields.ReadHeader();
  image.format = fields.ReadString();
  image.data = fields.ReadArray();
  return image;
}

RosCameraInfo ParseRosCameraInfo(std::string_view bytes) {
  Fields fields(bytes);
  RosCameraInfo info;
  info.header = fields.ReadHeader();
  info.height = fields.Read<uint32_t>();
  info.width = fields.Read<uint32_t>();
  info.distortion_model = fields.ReadString();
  const auto count = fields.Read<uint32_t>();
  constexpr uint32_t kMaxCoefficients = 14;  // of all models of ROS
  if (count > kMaxCoefficients) throw std::runtime_error("the message is no CameraInfo");
  info.d.resize(count);
  fields.ReadNumbers(info.d.data(), count);
  fields.ReadNumbers(info.k, 9);
  fields.ReadNumbers(info.r, 9);
  fields.ReadNumbers(info.p, 12);
  return info;
}

}  // namespace msc_vo
