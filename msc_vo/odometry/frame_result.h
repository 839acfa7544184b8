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

// Milliseconds per stage of one frame.
struct StageTimes {
  // Points, lines and their depths: wall time. The next three are summed over threads that work
  // side by side, and may together be more.
  double features = 0.0;
  double points = 0.0;
  double lines = 0.0;
  double depth = 0.0;
  double matching = 0.0;
  double pose = 0.0;
  double waiting = 0.0;   // for the map that the frame must see
  double tracking = 0.0;  // everything from the decoded images to the pose
  // Of what the mapper did with this frame, snapshots included; 0 for frames that are no keyframes
  // and, as it goes on behind Process(), until the maps have been seen.
  double mapping = 0.0;
  MappingTimes mapping_stages;
  double snapshot = 0.0;
};

// What is known of one frame once it has been processed.
struct FrameResult {
  int64_t id = 0;
  double timestamp = 0.0;  // seconds
  TrackingStatus status = TrackingStatus::kLost;
  Rigid3 cam_from_world;
  bool is_keyframe = false;
  int num_points = 0;  // features in the image
  int num_lines = 0;
  int num_with_depth = 0;     // points and lines whose depth was measured
  int num_inlier_points = 0;  // matched with the map and consistent with the pose
  int num_inlier_lines = 0;
  int num_dynamic = 0;  // matches with what moves by itself
  // Covariance of the pose in the tangent of Rigid3Manifold: rotation vector in the camera frame
  // (radians), then translation (metres). Zero where the pose was not estimated.
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
  ImageStatistics image;  // zero if the image was dropped
  StageTimes times;
};

}  // namespace msc_vo
