// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/exports/ros2_messages.h"

#include <array>

#include "msc_vo/exports/cdr_writer.h"
#include "msc_vo/exports/little_endian_bytes.h"

namespace msc_vo {

namespace {

constexpr int64_t kNanoseconds = 1'000'000'000;

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

void AddColor(const std::array<uint8_t, 3>& color, CdrWriter* cdr) {
  for (const uint8_t channel : color) cdr->AddFloat(static_cast<float>(channel) / 255.0f);
  cdr->AddFloat(1.0f);
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
  CdrWriter cdr;
  cdr.AddWord(1);
  AddHeader(header, &cdr);
  cdr.AddString("map_lines").AddInt(0).AddInt(kLineList).AddInt(0);  // namespace, id, type, add
  AddPose(Rigid3(), &cdr);
  AddVector({width, 0.0, 0.0}, &cdr);
  AddColor({255, 255, 255}, &cdr);
  cdr.AddInt(0).AddWord(0).AddByte(0);  // for ever, not locked to its frame
  const auto num_ends = static_cast<uint32_t>(2 * lines.size());
  cdr.AddWord(num_ends);
  for (const ColoredEdge& line : lines) {
    AddVector(line.segment.start, &cdr);
    AddVector(line.segment.end, &cdr);
  }
  cdr.AddWord(num_ends);
  for (const ColoredEdge& line : lines) {
    AddColor(line.color, &cdr);
    AddColor(line.color, &cdr);
  }
  cdr.AddString("");  // no texture
  AddHeader({}, &cdr);
  cdr.AddString("").AddBytes("").AddWord(0);      // its image and coordinates
  cdr.AddString("").AddString("").AddString("");  // no text, no mesh
  cdr.AddBytes("").AddByte(0);
  return cdr.Message();
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
