// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "msc_vo/camera/camera_intrinsics.h"
#include "msc_vo/camera/lens_distortion.h"
#include "msc_vo/camera/pinhole_camera.h"
#include "msc_vo/frame/depth_ranges.h"
#include "msc_vo/frame/feature_grid.h"
#include "msc_vo/frame/line_feature.h"
#include "msc_vo/frame/plane_feature.h"
#include "msc_vo/frame/point_feature.h"
#include "msc_vo/geometry/camera_velocity.h"

namespace msc_vo {

/// How the planes of a depth image were moved to the time of the colour image.
struct DepthMotion {
  double delay = 0.0;       ///< time of the depth image relative to the colour image, seconds
  CameraVelocity velocity;  ///< over that time
};

/// The features of one image. Image data is kept beyond this type for self-calibration only, see
/// RecordedImage.
///
/// A frame is immutable once it is built; poses and associations are stored separately, so that
/// frames can be shared between threads without locks.
struct Frame {
  int64_t id = 0;          ///< position in the sequence, from 0
  double timestamp = 0.0;  ///< seconds
  PinholeCamera camera;    ///< without distortion: features are undistorted already
  /// Lens that the features were recorded through, if undistortion moves them to quite other rows.
  std::optional<LensDistortion> lens = {};
  std::vector<PointFeature> points;
  std::vector<LineFeature> lines;
  std::vector<PlaneFeature> planes;
  FeatureGrid grid;  ///< over `points`
  /// With the calibration that the frame was built with, and without rolling-shutter compensation.
  /// A keyframe has none of dynamic surfaces.
  DepthRanges depth_ranges;
  /// Calibration that the features were undistorted with, whose camera is `camera`; null if it is
  /// unknown.
  std::shared_ptr<const CameraIntrinsics> intrinsics;
  /// Parameters of the rolling-shutter compensation that was applied to the features (see
  /// rolling_shutter.h): the camera's velocity, std::nullopt while it is unknown, and the readout
  /// time, seconds.
  std::optional<CameraVelocity> velocity;
  double readout_time = 0.0;
  /// Of `planes`: half a degree, which the error of a velocity turns them by, matters to them, and
  /// hardly to depths.
  DepthMotion depth_motion = {};

  /// Position in camera coordinates (metres) of a point that has a depth.
  Eigen::Vector3d PointInCamera(int index) const {
    const PointFeature& point = points[index];
    return camera.BackProject(point.pixel, 1.0 / point.inverse_depth);
  }
  /// Segment in camera coordinates (metres) of a line that has a depth.
  LineSegment3 LineInCamera(int index) const {
    return BackProject(camera, lines[index].segment, *lines[index].depth);
  }
};

/// Calls visit(features) for the features of every kind. The frame may be const.
template <typename FrameType, typename Visit>
void ForEachFeatures(FrameType& frame, const Visit& visit) {
  visit(frame.points);
  visit(frame.lines);
}

}  // namespace msc_vo
