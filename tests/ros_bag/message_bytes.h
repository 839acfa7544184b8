// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "msc_vo/ros_bag/ros_message.h"

namespace msc_vo {

// The serialised fields of a ROS message.
class MessageBytes {
 public:
  explicit MessageBytes(RosSerialization serialization = RosSerialization::kRos1)
      : is_cdr_(serialization == RosSerialization::kCdr),
        bytes_(is_cdr_ ? std::string("\0\1\0\0", 4) : "") {}

  template <typename Number>
  MessageBytes& Add(Number value) {
    // CDR aligns values to their size, counted from the end of the four bytes in front.
    while (is_cdr_ && (bytes_.size() - 4) % sizeof(value) != 0) bytes_ += '\0';
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof(value));
    return *this;
  }
  MessageBytes& AddArray(const std::string& bytes) {
    Add(static_cast<uint32_t>(bytes.size()));
    bytes_ += bytes;
    return *this;
  }
  MessageBytes& AddText(const std::string& text) { return AddArray(is_cdr_ ? text + '\0' : text); }
  MessageBytes& AddHeader(uint32_t seconds, uint32_t nanoseconds,
                          const std::string& frame = "/camera") {
    if (!is_cdr_) Add(uint32_t{7});
    return Add(seconds).Add(nanoseconds).AddText(frame);
  }
  template <typename Numbers>
  MessageBytes& AddEach(const Numbers& values) {
    for (const double value : values) Add(value);
    return *this;
  }
  const std::string& bytes() const { return bytes_; }

 private:
  bool is_cdr_;
  std::string bytes_;
};

inline std::string ImageMessage(uint32_t seconds, uint32_t nanoseconds, const cv::Mat& image,
                                const std::string& encoding,
                                RosSerialization serialization = RosSerialization::kRos1,
                                const std::string& frame = "/camera") {
  const cv::Mat pixels = image.clone();  // continuous
  const size_t step = pixels.cols * pixels.elemSize();
  return MessageBytes(serialization)
      .AddHeader(seconds, nanoseconds, frame)
      .Add(static_cast<uint32_t>(pixels.rows))
      .Add(static_cast<uint32_t>(pixels.cols))
      .AddText(encoding)
      .Add(uint8_t{0})
      .Add(static_cast<uint32_t>(step))
      .AddArray(std::string(reinterpret_cast<const char*>(pixels.data), step * pixels.rows))
      .bytes();
}

// Transforms without a rotation.
struct ShiftedFrame {
  std::string parent, child;
  std::vector<double> child_in_parent;
};

inline std::string TransformsMessage(const std::vector<ShiftedFrame>& transforms,
                                     RosSerialization serialization = RosSerialization::kRos1) {
  MessageBytes message(serialization);
  message.Add(static_cast<uint32_t>(transforms.size()));
  for (const ShiftedFrame& transform : transforms) {
    message.AddHeader(1, 0, transform.parent)
        .AddText(transform.child)
        .AddEach(transform.child_in_parent)
        .AddEach(std::vector<double>{0.0, 0.0, 0.0, 1.0});
  }
  return message.bytes();
}

inline std::string CompressedMessage(uint32_t seconds, uint32_t nanoseconds,
                                     const std::string& format, const std::string& data,
                                     RosSerialization serialization = RosSerialization::kRos1) {
  return MessageBytes(serialization)
      .AddHeader(seconds, nanoseconds)
      .AddText(format)
      .AddArray(data)
      .bytes();
}

struct CameraInfoFields {
  uint32_t width = 640, height = 480;
  double fx = 525.0, fy = 526.0, cx = 319.5, cy = 239.5;
  std::string model = "plumb_bob";
  std::vector<double> d = {0, 0, 0, 0, 0};
  uint32_t binning = 0;
  cv::Rect roi = {};
  std::string frame = "/camera";
};

inline std::string CameraInfoMessage(const CameraInfoFields& info,
                                     RosSerialization serialization = RosSerialization::kRos1) {
  using Numbers = std::vector<double>;
  return MessageBytes(serialization)
      .AddHeader(1, 0, info.frame)
      .Add(info.height)
      .Add(info.width)
      .AddText(info.model)
      .Add(static_cast<uint32_t>(info.d.size()))
      .AddEach(info.d)
      .AddEach(Numbers{info.fx, 0.0, info.cx, 0.0, info.fy, info.cy, 0.0, 0.0, 1.0})
      .AddEach(Numbers{1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0})
      .AddEach(Numbers{500.0, 0.0, 320.0, 0.0, 0.0, 501.0, 240.0, 0.0, 0.0, 0.0, 1.0, 0.0})
      .Add(info.binning)
      .Add(info.binning)
      .Add(static_cast<uint32_t>(info.roi.x))
      .Add(static_cast<uint32_t>(info.roi.y))
      .Add(static_cast<uint32_t>(info.roi.height))
      .Add(static_cast<uint32_t>(info.roi.width))
      .Add(uint8_t{0})
      .bytes();
}

}  // namespace msc_vo
