// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/exports/ros2_messages.h"

#include <array>

#include "msc_vo/exports/little_endian_bytes.h"
#include "msc_vo/ros_bag/fast_cdr.h"

namespace msc_vo {

namespace {

using namespace fast_cdr;

constexpr int64_t kNanoseconds = 1'000'000'000;

// Serialises the fields of a message, the lowest byte first.
class CdrWriter {
 public:
  CdrWriter() { cdr_.serialize_encapsulation(); }

  CdrWriter& AddByte(uint8_t value) { return Add(value); }
  CdrWriter& AddWord(uint32_t value) { return Add(value); }
  CdrWriter& AddInt(int32_t value) { return Add(value); }
  CdrWriter& AddFloat(float value) { return Add(value); }
  CdrWriter& AddDouble(double value) { return Add(value); }
  CdrWriter& AddString(const std::string& text) { return Add(text, sizeof(uint32_t)); }
  // Adds a sequence of bytes with its length.
  CdrWriter& AddBytes(std::string_view bytes) {
    AddWord(static_cast<uint32_t>(bytes.size()));
    if (!bytes.empty()) {
      AddArray(reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size(), &cdr_);
    }
    return *this;
  }
  template <typename Numbers>
  void AddDoubles(const Numbers& values) {
    for (const double value : values) AddDouble(value);
  }
  // The message so far.
  std::string Message() const { return {buffer_.getBuffer(), PositionOf(cdr_)}; }

 private:
  // Adds a value that is aligned to `size` bytes. The padding that Fast CDR adds is not
  // initialised.
  template <typename Value>
  CdrWriter& Add(const Value& value, size_t size = sizeof(Value)) {
    constexpr size_t kEncapsulation = 4;
    while ((PositionOf(cdr_) - kEncapsulation) % size != 0) cdr_ << uint8_t{0};
    cdr_ << value;
    return *this;
  }

  FastBuffer buffer_;  // grows
  Cdr cdr_ = Cdr(buffer_, Cdr::LITTLE_ENDIANNESS, kPlainCdr);
};

void AddHeader(const MessageHeader& header, CdrWriter* cdr) {
  cdr->AddInt(static_cast<int32_t>(header.nanoseconds / kNanoseconds));
  cdr->AddWord(static_cast<uint32_t>(header.nanoseconds % kNanoseconds));
  cdr->AddString(header.frame);
}

void AddVector(const Eigen::Vector3d& x, CdrWriter* cdr) {
  cdr->AddDoubles(Eigen::Vector3d(x.array() + 0.0));  // no -0
}

// geometry_msgs/Pose and geometry_msgs/Transform.
void AddPose(const Rigid3& pose, CdrWriter* cdr) {
  AddVector(pose.translation(), cdr);
  cdr->AddDoubles(Eigen::Vector4d(pose.rotation().coeffs().array() + 0.0));
}

void AddCovariance(const std::optional<RosCovariance>& covariance, CdrWriter* cdr) {
  const RosCovariance matrix = covariance.value_or(RosCovariance::Zero());
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column < 6; ++column) cdr->AddDouble(matrix(row, column) + 0.0);
  }
}

void AddColor(const std::array<uint8_t, 3>& color, float opacity, CdrWriter* cdr) {
  for (const uint8_t channel : color) cdr->AddFloat(static_cast<float>(channel) / 255.0f);
  cdr->AddFloat(opacity);
}

// What the markers of a kind have in common.
struct MarkerStyle {
  const char* name_space;
  int32_t type;
  Eigen::Vector3d scale;
  float opacity;
};

// Positions of a list marker, each with a colour.
struct MarkerList {
  std::vector<Eigen::Vector3d> positions;
  std::vector<std::array<uint8_t, 3>> colors;
};

// visualization_msgs/MarkerArray of one list marker.
std::string FormatMarkers(const MessageHeader& header, const MarkerStyle& style,
                          const MarkerList& list) {
  CdrWriter cdr;
  cdr.AddWord(1);
  AddHeader(header, &cdr);
  cdr.AddString(style.name_space).AddInt(0).AddInt(style.type).AddInt(0);  // id 0, add
  AddPose(Rigid3(), &cdr);
  AddVector(style.scale, &cdr);
  AddColor({255, 255, 255}, style.opacity, &cdr);
  cdr.AddInt(0).AddWord(0).AddByte(0);  // for ever, not locked to its frame
  const auto size = static_cast<uint32_t>(list.positions.size());
  cdr.AddWord(size);
  for (const Eigen::Vector3d& position : list.positions) AddVector(position, &cdr);
  cdr.AddWord(size);
  for (const std::array<uint8_t, 3>& color : list.colors) AddColor(color, style.opacity, &cdr);
  cdr.AddString("");  // no texture
  AddHeader({}, &cdr);
  cdr.AddString("").AddBytes("").AddWord(0);      // its image and coordinates
  cdr.AddString("").AddString("").AddString("");  // no text, no mesh
  cdr.AddBytes("").AddByte(0);
  return cdr.Message();
}

// sensor_msgs/PointField of one number.
void AddField(const std::string& name, uint32_t offset, uint8_t type, CdrWriter* cdr) {
  cdr->AddString(name).AddWord(offset).AddByte(type).AddWord(1);
}

}  // namespace

std::string FormatTransforms(const std::vector<FrameTransform>& transforms) {
  CdrWriter cdr;
  cdr.AddWord(static_cast<uint32_t>(transforms.size()));
  for (const FrameTransform& transform : transforms) {
    AddHeader(transform.header, &cdr);
    cdr.AddString(transform.child);
    AddPose(transform.frame_from_child, &cdr);
  }
  return cdr.Message();
}

std::string FormatPose(const MessageHeader& header, const Rigid3& pose,
                       const std::optional<RosCovariance>& covariance) {
  CdrWriter cdr;
  AddHeader(header, &cdr);
  AddPose(pose, &cdr);
  AddCovariance(covariance, &cdr);
  return cdr.Message();
}

std::string FormatOdometry(const MessageHeader& header, const std::string& child,
                           const Rigid3& pose, const std::optional<RosCovariance>& covariance,
                           const BodyVelocity& velocity) {
  CdrWriter cdr;
  AddHeader(header, &cdr);
  cdr.AddString(child);
  AddPose(pose, &cdr);
  AddCovariance(covariance, &cdr);
  AddVector(velocity.linear, &cdr);
  AddVector(velocity.angular, &cdr);
  AddCovariance(std::nullopt, &cdr);
  return cdr.Message();
}

std::string FormatPath(const MessageHeader& header, const std::vector<StampedPose>& poses) {
  CdrWriter cdr;
  AddHeader(header, &cdr);
  cdr.AddWord(static_cast<uint32_t>(poses.size()));
  for (const StampedPose& pose : poses) {
    AddHeader({pose.nanoseconds, header.frame}, &cdr);
    AddPose(pose.pose, &cdr);
  }
  return cdr.Message();
}

std::string FormatPointCloud(const MessageHeader& header, const std::vector<MapPoint>& points) {
  constexpr uint8_t kUint32 = 6, kFloat32 = 7;
  constexpr uint32_t kPointBytes = 16;
  LittleEndianBytes data;
  for (const MapPoint& point : points) {
    for (const double x : point.position) data.Add(static_cast<float>(x));
    data.Add(static_cast<uint32_t>(point.num_observations));
  }
  const auto num_points = static_cast<uint32_t>(points.size());
  CdrWriter cdr;
  AddHeader(header, &cdr);
  cdr.AddWord(1).AddWord(num_points).AddWord(4);
  AddField("x", 0, kFloat32, &cdr);
  AddField("y", 4, kFloat32, &cdr);
  AddField("z", 8, kFloat32, &cdr);
  AddField("observations", 12, kUint32, &cdr);
  cdr.AddByte(0).AddWord(kPointBytes).AddWord(kPointBytes * num_points);
  cdr.AddBytes(data.bytes()).AddByte(1);  // all points are finite
  return cdr.Message();
}

std::string FormatLineMarkers(const MessageHeader& header, const std::vector<ColoredEdge>& lines,
                              double width) {
  constexpr int32_t kLineList = 5;
  MarkerList list;
  for (const ColoredEdge& line : lines) {
    list.positions.insert(list.positions.end(), {line.segment.start, line.segment.end});
    list.colors.insert(list.colors.end(), 2, line.color);
  }
  return FormatMarkers(header, {"map_lines", kLineList, {width, 0.0, 0.0}, 1.0F}, list);
}

std::string FormatPolygonMarkers(const MessageHeader& header,
                                 const std::vector<ColoredPolygon>& polygons) {
  constexpr int32_t kTriangleList = 11;
  constexpr float kOpacity = 0.5F;
  MarkerList list;
  for (const ColoredPolygon& polygon : polygons) {
    for (size_t i = 2; i < polygon.vertices.size(); ++i) {
      for (const size_t corner : {size_t{0}, i - 1, i}) {
        list.positions.push_back(polygon.vertices[corner]);
        list.colors.push_back(polygon.color);
      }
    }
  }
  return FormatMarkers(header, {"map_planes", kTriangleList, {1.0, 1.0, 1.0}, kOpacity}, list);
}

std::string FormatCompressedImage(const MessageHeader& header, const std::string& format,
                                  std::string_view data) {
  CdrWriter cdr;
  AddHeader(header, &cdr);
  cdr.AddString(format).AddBytes(data);
  return cdr.Message();
}

std::string FormatCameraInfo(const MessageHeader& header, const CameraIntrinsics& intrinsics) {
  const LensDistortion& lens = intrinsics.distortion;
  const PinholeCamera& recorded = lens.Recorded(intrinsics.camera);
  const PinholeCamera& ideal = intrinsics.camera;
  std::vector<double> coefficients = lens.Coefficients();
  const char* model = "plumb_bob";
  if (lens.model == LensModel::kFisheye) model = "equidistant";
  if (lens.model == LensModel::kRational) model = "rational_polynomial";
  CdrWriter cdr;
  AddHeader(header, &cdr);
  cdr.AddWord(static_cast<uint32_t>(recorded.height))
      .AddWord(static_cast<uint32_t>(recorded.width));
  cdr.AddString(model).AddWord(static_cast<uint32_t>(coefficients.size()));
  cdr.AddDoubles(coefficients);
  cdr.AddDoubles(std::array<double, 9>{recorded.fx, 0.0, recorded.cx, 0.0, recorded.fy, recorded.cy,
                                       0.0, 0.0, 1.0});
  cdr.AddDoubles(std::array<double, 9>{1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0});
  cdr.AddDoubles(std::array<double, 12>{ideal.fx, 0.0, ideal.cx, 0.0, 0.0, ideal.fy, ideal.cy, 0.0,
                                        0.0, 0.0, 1.0, 0.0});
  for (int i = 0; i < 6; ++i) cdr.AddWord(0);  // no binning, the whole image
  cdr.AddByte(0);
  return cdr.Message();
}

}  // namespace msc_vo
