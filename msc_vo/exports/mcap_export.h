// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "msc_vo/camera/camera_intrinsics.h"
#include "msc_vo/geometry/pose_covariance.h"
#include "msc_vo/odometry/odometry.h"
#include "msc_vo/results/ply_file.h"

namespace msc_vo {

/// A frame of a run for ROS, with the axes of msc_vo.
struct McapFrame {
  int64_t nanoseconds = 0;  ///< since 1970
  Rigid3 world_from_cam;
  Rigid3 odom_from_cam;
  /// Covariances of the camera in the world and in `odom`, see CameraCovariance(); may be unknown.
  std::optional<PoseCovariance> world_covariance, odom_covariance;
  std::string image;  ///< PNG or JPEG file; empty: none
};

/// A run for ROS.
struct McapRun {
  std::vector<McapFrame> frames;  ///< by ascending time
  std::vector<MapPoint> points;
  std::vector<ColoredEdge> lines;
  std::vector<ColoredPolygon> planes;
  CameraIntrinsics camera;  ///< of the images, if there are any
  /// Returns a JPEG file of the image of frames[i] with its features, or nothing if that has none;
  /// may be empty.
  std::function<std::string(size_t i)> draw_features;
};

/// Writes a run as an MCAP file with messages of ROS 2:
///
/// | topic | type | frame |
/// |---|---|---|
/// | /tf | tf2_msgs/TFMessage | map -> odom -> camera -> camera_optical_frame |
/// | /msc_vo/pose | geometry_msgs/PoseWithCovarianceStamped | map |
/// | /msc_vo/odometry | nav_msgs/Odometry | odom; child: camera |
/// | /msc_vo/path | nav_msgs/Path | map; once, at the begin |
/// | /msc_vo/map_points | sensor_msgs/PointCloud2 | map; once |
/// | /msc_vo/map_lines | visualization_msgs/MarkerArray | map; once |
/// | /msc_vo/map_planes | visualization_msgs/MarkerArray | map; once, if there are planes |
/// | /camera/color/image_raw/compressed | sensor_msgs/CompressedImage | camera_optical_frame |
/// | /msc_vo/features/compressed | sensor_msgs/CompressedImage | camera_optical_frame |
/// | /camera/color/camera_info | sensor_msgs/CameraInfo | camera_optical_frame |
///
/// Throws std::runtime_error, naming the file, if it cannot be written, if an image is neither PNG
/// nor JPEG, and if msc_vo was built without Fast CDR or zstd.
void ExportMcap(const McapRun& run, const std::string& path);

/// Throws std::runtime_error if msc_vo was built without Fast CDR or zstd.
void RequireMcapExport();

}  // namespace msc_vo
