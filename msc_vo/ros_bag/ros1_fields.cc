// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/ros_bag/little_endian_fields.h"
#include "msc_vo/ros_bag/ros_fields.h"

namespace msc_vo {

namespace {

class Ros1Fields : public RosFields {
 public:
  explicit Ros1Fields(std::string_view message) : fields_(message) {}

  bool IsAtEnd() const override { return fields_.size() == 0; }
  uint8_t ReadByte() override { return fields_.Read<uint8_t>(); }
  uint32_t ReadWord() override { return fields_.Read<uint32_t>(); }
  float ReadFloat() override { return fields_.Read<float>(); }
  double ReadDouble() override { return fields_.Read<double>(); }
  std::string ReadString() override { return fields_.ReadString(); }
  std::string_view ReadBytes() override { return fields_.ReadArray(); }
  RosHeader ReadHeader() override {
    ReadWord();  // sequence number
    return RosFields::ReadHeader();
  }

 private:
  LittleEndianFields fields_;
};

}  // namespace

std::unique_ptr<RosFields> OpenRos1Fields(std::string_view message) {
  return std::make_unique<Ros1Fields>(message);
}

}  // namespace msc_vo
