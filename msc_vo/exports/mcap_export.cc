// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/exports/mcap_export.h"

#include <filesystem>
#include <map>
#include <stdexcept>
#include <system_error>

#include "msc_vo/exports/mcap_writer.h"
#include "msc_vo/exports/ros2_definitions.h"
#include "msc_vo/exports/ros2_messages.h"
#include "msc_vo/exports/ros_axes.h"
#include "msc_vo/geometry/so3.h"
#include "msc_vo/text/files.h"

namespace msc_vo {

namespace {

// Frames of REP 105.
constexpr char kMap[] = "map";                       // corrected, may jump
constexpr char kOdometry[] = "odom";                 // continuous, drifts
constexpr char kCamera[] = "camera";                 // x forward, y left, z up
constexpr char kOptical[] = "camera_optical_frame";  // x right, y down, z forward

constexpr double kLineWidth = 0.01;  // metres, of lines of the map

// Writes messages to topics.
class RosBag {
 public:
  explicit RosBag(const std::string& path) : writer_(path) {}

  void Write(const std::string& topic, const std::string& type, int64_t nanoseconds,
             const std::string& message) {
    auto channel = channels_.find(topic);
    if (channel == channels_.end()) {
      channel = channels_.emplace(topic, writer_.AddChannel(topic, Ros2Schema(type))).first;
    }
    writer_.Write(channel->second, static_cast<uint64_t>(nanoseconds), message);
  }
  void Finish() { writer_.Finish(); }

 private:
  McapWriter writer_;
  std::map<std::string, uint16_t> channels_;
};

// Path and map, at the time of the first frame.
void WriteMap(const McapRun& run, RosBag* bag) {
  const int64_t time = run.frames.front().nanoseconds;
  const MessageHeader header = {time, kMap};
  std::vector<StampedPose> path;
  for (const McapFrame& frame : run.frames) {
    path.push_back({frame.nanoseconds, WithRosAxes(frame.world_from_cam)});
  }
  bag->Write("/msc_vo/path", "nav_msgs/Path", time, FormatPath(header, path));
  std::vector<MapPoint> points = run.points;
  for (MapPoint& point : points) point.position = WithRosAxes(point.position);
  bag->Write("/msc_vo/map_points", "sensor_msgs/PointCloud2", time,
             FormatPointCloud(header, points));
  std::vector<ColoredEdge> lines = run.lines;
  for (ColoredEdge& line : lines) {
    line.segment = {WithRosAxes(line.segment.start), WithRosAxes(line.segment.end)};
  }
  bag->Write("/msc_vo/map_lines", "visualization_msgs/MarkerArray", time,
             FormatLineMarkers(header, lines, kLineWidth));
  if (run.planes.empty()) return;
  std::vector<ColoredPolygon> planes = run.planes;
  for (ColoredPolygon& plane : planes) {
    for (Eigen::Vector3d& vertex : plane.vertices) vertex = WithRosAxes(vertex);
  }
  bag->Write("/msc_vo/map_planes", "visualization_msgs/MarkerArray", time,
             FormatPolygonMarkers(header, planes));
}

// The mean velocity since the frame before; zero for the first one.
BodyVelocity VelocityOf(const McapFrame* before, const McapFrame& frame) {
  if (before == nullptr || before->nanoseconds >= frame.nanoseconds) return {};
  const double seconds = 1e-9 * static_cast<double>(frame.nanoseconds - before->nanoseconds);
  const Rigid3 motion =
      WithRosAxes(before->odom_from_cam).Inverse() * WithRosAxes(frame.odom_from_cam);
  const Eigen::Quaterniond now_from_before(motion.rotation().conjugate());
  return {now_from_before * motion.translation() / seconds,
          LogSO3(Eigen::Quaterniond(motion.rotation())) / seconds};
}

void WritePoses(const McapFrame* before, const McapFrame& frame, RosBag* bag) {
  const int64_t time = frame.nanoseconds;
  const Rigid3 map_from_camera = WithRosAxes(frame.world_from_cam);
  const Rigid3 odom_from_camera = WithRosAxes(frame.odom_from_cam);
  bag->Write(
      "/tf", "tf2_msgs/TFMessage", time,
      FormatTransforms({{{time, kMap}, kOdometry, map_from_camera * odom_from_camera.Inverse()},
                        {{time, kOdometry}, kCamera, odom_from_camera},
                        {{time, kCamera}, kOptical, {RosFromOptical(), Eigen::Vector3d::Zero()}}}));
  const auto with_ros_axes = [](const Rigid3& pose, const std::optional<PoseCovariance>& camera) {
    return camera ? std::make_optional(
                        CovarianceWithRosAxes(Eigen::Quaterniond(pose.rotation()), *camera))
                  : std::nullopt;
  };
  bag->Write("/msc_vo/pose", "geometry_msgs/PoseWithCovarianceStamped", time,
             FormatPose({time, kMap}, map_from_camera,
                        with_ros_axes(frame.world_from_cam, frame.world_covariance)));
  bag->Write("/msc_vo/odometry", "nav_msgs/Odometry", time,
             FormatOdometry({time, kOdometry}, kCamera, odom_from_camera,
                            with_ros_axes(frame.odom_from_cam, frame.odom_covariance),
                            VelocityOf(before, frame)));
}

void WriteImage(const McapFrame& frame, const CameraIntrinsics& camera, RosBag* bag) {
  const MessageHeader header = {frame.nanoseconds, kOptical};
  const std::string bytes = ReadFile(frame.image, kMaxImageBytes);
  const bool is_png = bytes.rfind("\x89PNG", 0) == 0;
  if (!is_png && bytes.rfind("\xFF\xD8\xFF", 0) != 0) {
    throw std::runtime_error(frame.image +
                             ": is neither PNG nor JPEG, which are the compressed images of ROS; "
                             "convert the sequence with msc_vo record, or leave out --images");
  }
  bag->Write("/camera/color/image_raw/compressed", "sensor_msgs/CompressedImage", frame.nanoseconds,
             FormatCompressedImage(header, is_png ? "png" : "jpeg", bytes));
  bag->Write("/camera/color/camera_info", "sensor_msgs/CameraInfo", frame.nanoseconds,
             FormatCameraInfo(header, camera));
}

// An image that shows features in every viewer, with or without their messages.
void WriteFeatures(const McapFrame& frame, const std::string& jpeg, RosBag* bag) {
  if (jpeg.empty()) return;
  bag->Write("/msc_vo/features/compressed", "sensor_msgs/CompressedImage", frame.nanoseconds,
             FormatCompressedImage({frame.nanoseconds, kOptical}, "jpeg", jpeg));
}

void WriteRun(const McapRun& run, const std::string& path) {
  RosBag bag(path);
  if (!run.frames.empty()) WriteMap(run, &bag);
  const McapFrame* before = nullptr;
  for (size_t i = 0; i < run.frames.size(); ++i) {
    const McapFrame& frame = run.frames[i];
    WritePoses(before, frame, &bag);
    if (!frame.image.empty()) WriteImage(frame, run.camera, &bag);
    if (run.draw_features) WriteFeatures(frame, run.draw_features(i), &bag);
    before = &frame;
  }
  bag.Finish();
}

}  // namespace

void RequireMcapExport() {}

void ExportMcap(const McapRun& run, const std::string& path) {
  const std::string part = path + ".part";
  try {
    WriteRun(run, part);
    std::filesystem::rename(part, path);
  } catch (...) {
    std::error_code ignored;
    std::filesystem::remove(part, ignored);
    throw;
  }
}

}  // namespace msc_vo
