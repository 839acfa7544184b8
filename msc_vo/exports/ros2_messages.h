// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "msc_vo/camera/camera_intrinsics.h"
#include "msc_vo/exports/ros_axes.h"
#include "msc_vo/odometry/map_result.h"
#include "msc_vo/results/ply_file.h"

namespace msc_vo {

// Messages of ROS 2 in CDR. All lengths are in metres; poses, points and covariances have the axes
// of ROS already, see ros_axes.h.

/// std_msgs/Header.
struct MessageHeader {
  int64_t nanoseconds = 0;  ///< since 1970
  std::string frame;
};

/// geometry_msgs/TransformStamped: the pose of `child` in header.frame.
struct FrameTransform {
  MessageHeader header;
  std::string child;
  Rigid3 frame_from_child;
};
/// tf2_msgs/TFMessage.
std::string FormatTransforms(const std::vector<FrameTransform>& transforms);

/// geometry_msgs/PoseWithCovarianceStamped. Without a covariance its numbers are 0, which means
/// that it is unknown.
std::string FormatPose(const MessageHeader& header, const Rigid3& pose,
                       const std::optional<RosCovariance>& covariance);

/// Velocity of a frame in its own axes.
struct BodyVelocity {
  Eigen::Vector3d linear = Eigen::Vector3d::Zero();   ///< m/s
  Eigen::Vector3d angular = Eigen::Vector3d::Zero();  ///< rad/s
};
/// nav_msgs/Odometry. The covariance of the velocity is unknown.
std::string FormatOdometry(const MessageHeader& header, const std::string& child,
                           const Rigid3& pose, const std::optional<RosCovariance>& covariance,
                           const BodyVelocity& velocity);

struct StampedPose {
  int64_t nanoseconds = 0;
  Rigid3 pose;
};
/// nav_msgs/Path.
std::string FormatPath(const MessageHeader& header, const std::vector<StampedPose>& poses);

/// sensor_msgs/PointCloud2: x y z (float) and the number of observations (uint32).
std::string FormatPointCloud(const MessageHeader& header, const std::vector<MapPoint>& points);

/// visualization_msgs/MarkerArray of one LINE_LIST, which RViz and Foxglove draw as one object: a
/// marker for each line would be slow. `width`: metres.
std::string FormatLineMarkers(const MessageHeader& header, const std::vector<ColoredEdge>& lines,
                              double width);

/// visualization_msgs/MarkerArray of one TRIANGLE_LIST: the polygons, translucent.
std::string FormatPolygonMarkers(const MessageHeader& header,
                                 const std::vector<ColoredPolygon>& polygons);

/// sensor_msgs/CompressedImage. `format`: "png" or "jpeg".
std::string FormatCompressedImage(const MessageHeader& header, const std::string& format,
                                  std::string_view data);

/// sensor_msgs/CameraInfo of the recorded images.
std::string FormatCameraInfo(const MessageHeader& header, const CameraIntrinsics& intrinsics);

}  // namespace msc_vo
