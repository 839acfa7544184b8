// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "msc_vo/features/image_statistics.h"
#include "msc_vo/geometry/rigid3.h"
#include "msc_vo/mapping/mapper.h"
#include "msc_vo/tracking/tracking_status.h"

namespace msc_vo {

struct TrackedFrame;

/// Time of each stage of one frame, milliseconds.
struct StageTimes {
  /// Wall time of points, lines and their depths. The next three are summed over parallel threads,
  /// so that their sum may be larger.
  double features = 0.0;
  double points = 0.0;
  double lines = 0.0;
  double depth = 0.0;
  double matching = 0.0;
  double pose = 0.0;
  double waiting = 0.0;   ///< for the map that the frame is tracked in
  double tracking = 0.0;  ///< total, from the decoded images to the pose
  /// Local mapping of this frame, snapshots included. 0 unless the frame is a keyframe; set after
  /// Process(), because mapping runs in parallel.
  double mapping = 0.0;
  MappingTimes mapping_stages;
  double snapshot = 0.0;  ///< snapshots of the map; part of `mapping`

  template <typename Archive>
  void Serialize(Archive& archive) {
    archive.Fields(*this, features, points, lines, depth, matching, pose, waiting, tracking,
                   mapping, mapping_stages, snapshot);
  }
};

/// FrameResult::segment of a frame without one.
constexpr int kNoSegment = -1;

/// Result of one frame.
struct FrameResult {
  int64_t id = 0;
  double timestamp = 0.0;  ///< seconds
  TrackingStatus status = TrackingStatus::kLost;
  /// Number of the segment of the run (OdometryResult::segments). kNoSegment: the frame precedes
  /// the first one and has no pose.
  int segment = 0;
  Rigid3 cam_from_world;
  bool by_pose_factors = false;  ///< predicted by pose factors, not by constant velocity
  bool is_keyframe = false;
  int num_points = 0;  ///< features in the image
  int num_lines = 0;
  int num_with_depth = 0;     ///< points and lines with a measured depth
  int num_inlier_points = 0;  ///< matched with the map and consistent with the pose
  int num_inlier_lines = 0;
  int num_dynamic = 0;  ///< matches on dynamic objects
  /// Covariance of the pose in the tangent of Rigid3Manifold: rotation vector in the camera frame
  /// (radians), then translation (metres). Zero if neither the image nor pose factors determined
  /// the pose.
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
  ImageStatistics image;  ///< zero if the image was not processed
  StageTimes times;

  template <typename Archive>
  void Serialize(Archive& archive) {
    archive.Fields(*this, id, timestamp, status, segment, cam_from_world, by_pose_factors,
                   is_keyframe, num_points, num_lines, num_with_depth, num_inlier_points,
                   num_inlier_lines, num_dynamic, covariance, image, times);
  }
};

/// The result of a tracked frame in a segment, without statistics of its image and without times of
/// other stages than tracking.
FrameResult MakeFrameResult(const TrackedFrame& tracked, int segment);

}  // namespace msc_vo
