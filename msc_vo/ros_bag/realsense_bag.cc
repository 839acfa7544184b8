// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "msc_vo/ros_bag/bag_formats.h"
#include "msc_vo/ros_bag/topic_choice.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace {

constexpr char kPrefix[] = "librealsense/";
constexpr char kFrame[] = "librealsense/raw_frame";
constexpr char kCameraInfo[] = "librealsense/camera_info";
constexpr char kExtrinsics[] = "librealsense/extrinsics";
constexpr char kText[] = "librealsense/string";

// The type of ROS as which a topic is shown; empty if it is left out.
std::string RosType(const BagTopic& topic) {
  if (topic.type == kFrame) return "sensor_msgs/Image";
  if (topic.type == kCameraInfo) return "sensor_msgs/CameraInfo";
  if (topic.type == kExtrinsics) return "geometry_msgs/Transform";
  const bool is_option = topic.type == kText && topic.name.find("/option/") != std::string::npos;
  const size_t value = topic.name.rfind("/value");
  return is_option && value != std::string::npos && value + 6 == topic.name.size()
             ? "std_msgs/Float32"
             : "";
}

double Number(const std::string& text) {
  const std::optional<double> number = ParseNumber(Trimmed(text));
  if (!number) throw std::runtime_error("'" + text + "' is no number");
  return *number;
}

// Values of a text such as "width=640;height=480;coeffs=0.1,0.2".
class TextFields {
 public:
  explicit TextFields(const std::string& text) {
    for (const std::string& field : SplitAt(text, ';')) {
      const size_t sign = field.find('=');
      if (sign != std::string::npos) fields_[field.substr(0, sign)] = field.substr(sign + 1);
    }
  }

  const std::string& Text(const std::string& name) const {
    const auto found = fields_.find(name);
    if (found == fields_.end()) throw std::runtime_error("the message has no '" + name + "'");
    return found->second;
  }
  double Value(const std::string& name) const { return Number(Text(name)); }
  // A number of pixels.
  uint32_t Size(const std::string& name) const {
    constexpr double kMaxSide = 16384.0;
    const double value = Value(name);
    if (!(value >= 1.0 && value <= kMaxSide)) {
      throw std::runtime_error("'" + name + "' is no size of an image");
    }
    return static_cast<uint32_t>(value);
  }
  std::vector<double> Values(const std::string& name) const {
    std::vector<double> values;
    for (const std::string& value : SplitAt(Text(name), ',')) values.push_back(Number(value));
    return values;
  }

 private:
  static std::vector<std::string> SplitAt(const std::string& text, char separator) {
    std::vector<std::string> parts;
    for (size_t at = 0; at <= text.size();) {
      const size_t end = std::min(text.find(separator, at), text.size());
      parts.push_back(text.substr(at, end - at));
      at = end + 1;
    }
    return parts;
  }

  std::map<std::string, std::string> fields_;
};

// A message in the serialisation of ROS 1.
class Ros1Message {
 public:
  template <typename Number>
  Ros1Message& Add(Number value) {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof(value));
    return *this;
  }
  template <typename Numbers>
  Ros1Message& AddEach(const Numbers& values) {
    for (const auto value : values) Add(value);
    return *this;
  }
  Ros1Message& AddArray(const std::string& bytes) {
    Add(static_cast<uint32_t>(bytes.size()));
    bytes_ += bytes;
    return *this;
  }
  Ros1Message& AddHeader(double stamp = 0.0) {
    const auto seconds = static_cast<uint32_t>(stamp);
    const auto nanoseconds = static_cast<uint32_t>(std::llround(1e9 * (stamp - seconds)));
    return Add(uint32_t{0}).Add(seconds).Add(std::min(nanoseconds, 999999999u)).AddArray("");
  }
  std::string Take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

std::string CameraInfoMessage(const TextFields& info) {
  const std::vector<double> coefficients = info.Values("coeffs");
  const double fx = info.Value("fx"), fy = info.Value("fy");
  const double cx = info.Value("ppx"), cy = info.Value("ppy");
  return Ros1Message()
      .AddHeader()
      .Add(info.Size("height"))
      .Add(info.Size("width"))
      .AddArray(info.Text("model"))
      .Add(static_cast<uint32_t>(coefficients.size()))
      .AddEach(coefficients)
      .AddEach(std::array<double, 9>{fx, 0, cx, 0, fy, cy, 0, 0, 1})
      .AddEach(std::array<double, 9>{1, 0, 0, 0, 1, 0, 0, 0, 1})
      .AddEach(std::array<double, 12>{fx, 0, cx, 0, 0, fy, cy, 0, 0, 0, 1, 0})
      .AddEach(std::array<uint32_t, 6>{})  // neither binning nor a region
      .Take();
}

std::string TransformMessage(const TextFields& extrinsics) {
  const std::vector<double> rotation = extrinsics.Values("rotation");  // column by column
  const std::vector<double> translation = extrinsics.Values("translation");
  if (rotation.size() != 9 || translation.size() != 3) {
    throw std::runtime_error("the message is no transform");
  }
  const Eigen::Quaterniond quaternion(Eigen::Matrix3d(Eigen::Matrix3d::Map(rotation.data())));
  return Ros1Message()
      .AddEach(translation)
      .AddEach(
          std::array<double, 4>{quaternion.x(), quaternion.y(), quaternion.z(), quaternion.w()})
      .Take();
}

// The encoding of ROS and the bytes per pixel of a format of the library.
std::pair<std::string, uint32_t> EncodingOf(const std::string& format) {
  static const std::map<std::string, std::pair<std::string, uint32_t>> encodings = {
      {"Z16", {"16UC1", 2}}, {"Y16", {"mono16", 2}},  {"Y8", {"mono8", 1}},   {"RGB8", {"rgb8", 3}},
      {"BGR8", {"bgr8", 3}}, {"RGBA8", {"rgba8", 4}}, {"BGRA8", {"bgra8", 4}}};
  const auto found = encodings.find(format);
  return found == encodings.end() ? std::pair(format, uint32_t{1}) : found->second;
}

class RealSenseBag : public BagFile {
 public:
  explicit RealSenseBag(std::unique_ptr<BagFile> bag) : BagFile(bag->path()), bag_(std::move(bag)) {
    std::vector<BagTopic> topics;
    for (const BagTopic& topic : bag_->topics()) {
      const std::string type = RosType(topic);
      if (!type.empty()) topics.push_back({topic.name, type, RosSerialization::kRos1});
    }
    SetTopics(std::move(topics));
    for (const std::string& warning : bag_->warnings()) Warn(warning);
  }

 private:
  int DoCount(const BagTopic& topic) const override { return bag_->NumMessages(topic.name); }
  double DoReceiveTime(const BagTopic& topic, int i) const override {
    return bag_->ReceiveTime(topic.name, i);
  }
  std::string DoRead(const BagTopic& topic, int i) const override {
    const std::string bytes = bag_->Read(topic.name, i);
    if (topic.type == "sensor_msgs/Image")
      return ImageMessage(topic.name, bag_->ReceiveTime(topic.name, i), bytes);
    if (topic.type == "sensor_msgs/CameraInfo") return CameraInfoMessage(TextFields(bytes));
    if (topic.type == "geometry_msgs/Transform") return TransformMessage(TextFields(bytes));
    return Ros1Message().Add(static_cast<float>(Number(bytes))).Take();
  }

  // The size of the image is in its camera_info, its encoding in the topic above that.
  // Its time is that of recording, which the library sets to that of the frame.
  std::string ImageMessage(const std::string& topic, double time, const std::string& pixels) const {
    const std::string camera_info = CameraInfoTopicOf(topic);
    const TextFields camera(FirstText(camera_info));
    const TextFields stream(FirstText(camera_info.substr(0, camera_info.rfind('/'))));
    const auto [encoding, pixel_bytes] = EncodingOf(stream.Text("encoding"));
    const uint32_t width = camera.Size("width"), height = camera.Size("height");
    return Ros1Message()
        .AddHeader(time)
        .Add(height)
        .Add(width)
        .AddArray(encoding)
        .Add(uint8_t{0})
        .Add(std::max(width * pixel_bytes, static_cast<uint32_t>(pixels.size() / height)))
        .AddArray(pixels)
        .Take();
  }

  std::string FirstText(const std::string& topic) const {
    if (!bag_->HasMessages(topic)) throw std::runtime_error("the bag has no " + topic);
    return bag_->Read(topic, 0);
  }

  std::unique_ptr<BagFile> bag_;
};

}  // namespace

bool IsRealSenseBag(const BagFile& bag) {
  return std::any_of(bag.topics().begin(), bag.topics().end(),
                     [](const BagTopic& topic) { return topic.type.rfind(kPrefix, 0) == 0; });
}

std::unique_ptr<BagFile> TranslateRealSenseBag(std::unique_ptr<BagFile> bag) {
  return std::make_unique<RealSenseBag>(std::move(bag));
}

}  // namespace msc_vo
