// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>
#include <string>

namespace msc_vo {

enum class BagCompression { kNone, kBz2, kLz4 };

// Writes a bag of ROS 1 from serialised messages.
class BagWriter {
 public:
  BagWriter(const std::string& path, BagCompression compression);
  ~BagWriter();
  // `type` is "Image", "CompressedImage" or "CameraInfo" of sensor_msgs. `seconds`: of recording.
  void Write(const std::string& topic, const std::string& type, double seconds,
             const std::string& bytes);

 private:
  struct Bag;
  std::unique_ptr<Bag> bag_;
};

}  // namespace msc_vo
