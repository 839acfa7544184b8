// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "msc_vo/ros_bag/ros_message.h"

namespace msc_vo {

/// Reads the fields of a serialised message in their order. Views point into the message. All
/// functions throw std::runtime_error if the message ends too early.
class RosFields {
 public:
  virtual ~RosFields() = default;

  /// Tests whether all bytes have been read.
  virtual bool IsAtEnd() const = 0;
  virtual uint8_t ReadByte() = 0;
  virtual uint32_t ReadWord() = 0;
  virtual float ReadFloat() = 0;
  virtual double ReadDouble() = 0;
  virtual std::string ReadString() = 0;
  /// A sequence of bytes.
  virtual std::string_view ReadBytes() = 0;
  virtual RosHeader ReadHeader() {
    const uint32_t seconds = ReadWord();
    const uint32_t nanoseconds = ReadWord();
    return {SecondsOf(seconds, nanoseconds), ReadFrame()};
  }
  /// Name of a coordinate frame, without the slash that names of ROS 1 may begin with.
  std::string ReadFrame() {
    std::string name = ReadString();
    if (!name.empty() && name.front() == '/') name.erase(0, 1);
    return name;
  }

  void ReadDoubles(double* values, size_t count) {
    for (size_t i = 0; i < count; ++i) values[i] = ReadDouble();
  }
};

/// The message must outlive the fields.
std::unique_ptr<RosFields> OpenRos1Fields(std::string_view message);
/// Throws std::runtime_error that names what to install if msc_vo was built without Fast CDR.
std::unique_ptr<RosFields> OpenCdrFields(std::string_view message);

}  // namespace msc_vo
