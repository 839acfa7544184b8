// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <optional>

#include "msc_vo/features/image_statistics.h"
#include "msc_vo/geometry/pose_covariance.h"
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
};

/// FrameResult::segment of a frame without one.
constexpr int kNoSegment = -1;

/// Probable cause why a processed frame has no estimated pose, or a weak one: the first one that
/// applies, in the order of processing.
enum class LossCause {
  kUniformImage,     ///< image without contrast: black, white or grey
  kFewFeatures,      ///< image with contrast, but too few points and lines
  kNoDepth,          ///< features, but almost no pixel with a depth
  kDepthOutOfRange,  ///< depth image, but too few features with a depth in the valid range
  kNoMatch,          ///< features with depth, but no or few are consistent with the map
  kImplausible,      ///< weak: the pose follows a gap, and may be that of a place that looks alike
};
/// Causes of frames without an estimated pose: all but the last one.
constexpr int kNumLossCauses = 5;

/// Poses refer to another world than those of the frames before, or a loop has moved the map around
/// the camera.
struct WorldChange {
  int old_world = 0;  ///< number of the world of the frame before
  /// From the old world to the new one: the map has been joined with an older one, or a loop was
  /// closed, which moves the map by as much as this where the camera is.
  /// cam_from_new = cam_from_old * new_from_old.Inverse(). std::nullopt: unknown, because a segment
  /// begins; its world may have the number of the old one if that was discarded.
  std::optional<Rigid3> new_from_old;
};

/// Result of one frame.
struct FrameResult {
  int64_t id = 0;
  double timestamp = 0.0;  ///< seconds
  TrackingStatus status = TrackingStatus::kLost;
  /// Number of the segment of the run (OdometryResult::segments). kNoSegment: the frame precedes
  /// the first one and has no pose.
  int segment = 0;
  /// Number of the world that `cam_from_world` refers to: that of the segment that began it.
  /// kNoSegment: the frame has no pose.
  int world = 0;
  /// Set on the first frame whose pose refers to another world than that of the frame before, or to
  /// a map that a loop has moved since.
  std::optional<WorldChange> world_changed;
  /// The pose in the map as it was known when the frame was tracked. It jumps when the map is
  /// corrected, found again, or joined with an older one.
  Rigid3 cam_from_world;
  /// The pose by integration of the motion between images. It drifts; joins and corrections of the
  /// map do not change it. Motion that no image shows is missing: after a gap, it continues from
  /// the pose before; if the camera is found in another place from one image to the next, it rests.
  /// A pose factor that measures the absolute pose makes it jump. Identity at the
  /// first tracked frame.
  Rigid3 cam_from_odometry;
  bool by_pose_factors = false;  ///< predicted by pose factors, not by constant velocity
  bool is_keyframe = false;
  int num_points = 0;  ///< features in the image
  int num_lines = 0;
  int num_with_depth = 0;     ///< points and lines with a measured depth
  int num_inlier_points = 0;  ///< matched with the map and consistent with the pose
  int num_inlier_lines = 0;
  int num_dynamic = 0;  ///< matches on dynamic objects
  /// Covariance of `cam_from_world` relative to the map nearby, without the drift of the map, in
  /// the tangent of Rigid3Manifold: rotation vector in the camera frame (radians), then translation
  /// (metres). std::nullopt if neither the image nor pose factors determined the pose, as in the
  /// frame that begins a world: its pose is a definition.
  std::optional<PoseCovariance> covariance;
  /// Covariance of `cam_from_world` relative to the origin of the world, its first keyframe:
  /// `covariance`, the common error of the landmarks nearby, and the drift of the map between both,
  /// which closed loops reduce. Tangent and std::nullopt as `covariance`.
  std::optional<PoseCovariance> world_covariance;
  /// Covariance of `cam_from_odometry`: the drift of the whole path, which neither a correction of
  /// the map nor a known place reduces, and motion that was missed in gaps. Tangent (with
  /// `cam_from_odometry`) and std::nullopt as `covariance`. Its errors and those of
  /// `cam_from_world` are correlated.
  std::optional<PoseCovariance> odometry_covariance;
  /// Why the pose is weak, or was not estimated from the image; std::nullopt: the frame is tracked,
  /// or has no image.
  std::optional<LossCause> cause;
  ImageStatistics image;  ///< zero if the image was not processed
  StageTimes times;

  template <typename Archive>
  void Serialize(Archive& archive) {
    archive.Fields(*this, id, timestamp, status, segment, world, world_changed, cam_from_world,
                   cam_from_odometry, by_pose_factors, is_keyframe, num_points, num_lines,
                   num_with_depth, num_inlier_points, num_inlier_lines, num_dynamic, covariance,
                   world_covariance, odometry_covariance, cause, image, times);
  }

  /// The pose of the odometry frame in the world ("map from odom"): it takes all jumps.
  Rigid3 WorldFromOdometry() const { return cam_from_world.Inverse() * cam_from_odometry; }
};

/// The result of a tracked frame in a segment and a world, without what depends on its image or on
/// other frames, and without times of other stages than tracking.
FrameResult MakeFrameResult(const TrackedFrame& tracked, int segment, int world);

/// A frame whose image is not tracked, with the poses of the frame `before` it; nullptr: none.
FrameResult RepeatPose(const FrameResult* before);

/// Makes `result` a frame of a segment that is discarded: if it has an image, it is lost since
/// `before`.
void Discard(const FrameResult& before, FrameResult* result);

}  // namespace msc_vo
