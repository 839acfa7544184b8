// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

namespace msc_vo {

// The serialised fields of a ROS message.
class MessageBytes {
 public:
  template <typename Number>
  MessageBytes& Add(Number value) {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof(value));
    return *this;
  }
  MessageBytes& AddArray(const std::string& bytes) {
    Add(static_cast<uint32_t>(bytes.size()));
    bytes_ += bytes;
    return *this;
  }
  MessageBytes& AddHeader(uint32_t seconds, uint32_t nanoseconds) {
    return Add(uint32_t{7}).Add(seconds).Add(nanoseconds).AddArray("/camera");
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

inline std::string ImageMessage(uint32_t seconds, uint32_t nanoseconds, const cv::Mat& image,
                                const std::string& encoding) {
  const cv::Mat pixels = image.clone();  // continuous
  const size_t step = pixels.cols * pixels.elemSize();
  return MessageBytes()
      .AddHeader(seconds, nanoseconds)
      .Add(static_cast<uint32_t>(pixels.rows))
      .Add(static_cast<uint32_t>(pixels.cols))
      .AddArray(encoding)
      .Add(uint8_t{0})
      .Add(static_cast<uint32_t>(step))
      .AddArray(std::string(reinterpret_cast<const char*>(pixels.data), step * pixels.rows))
      .bytes();
}

inline std::string CompressedMessage(uint32_t seconds, uint32_t nanoseconds,
                                     const std::string& format, const std::string& data) {
  return MessageBytes().AddHeader(seconds, nanoseconds).AddArray(format).AddArray(data).bytes();
}

struct CameraInfoFields {
  uint32_t width = 640, height = 480;
  double fx = 525.0, fy = 526.0, cx = 319.5, cy = 239.5;
  std::string model = "plumb_bob";
  std::vector<double> d = {0, 0, 0, 0, 0};
};

inline std::string CameraInfoMessage(const CameraInfoFields& info) {
  MessageBytes bytes;
  bytes.AddHeader(1, 0).Add(info.height).Add(info.width).AddArray(info.model);
  bytes.Add(static_cast<uint32_t>(info.d.size()));
  for (const double k : info.d) bytes.Add(k);
  for (const double k : {info.fx, 0.0, info.cx, 0.0, info.fy, info.cy, 0.0, 0.0, 1.0}) bytes.Add(k);
  for (const double r : {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0}) bytes.Add(r);
  for (const double p : {500.0, 0.0, 320.0, 0.0, 0.0, 501.0, 240.0, 0.0, 0.0, 0.0, 1.0, 0.0}) {
    bytes.Add(p);
  }
  return bytes.bytes();
}

}  // namespace msc_vo
