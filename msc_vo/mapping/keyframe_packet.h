// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "msc_vo/frame/frame.h"
#include "msc_vo/geometry/camera_velocity.h"
#include "msc_vo/geometry/pose_covariance.h"
#include "msc_vo/geometry/rigid3.h"
#include "msc_vo/map/landmark.h"
#include "msc_vo/map/last_tracked_pose.h"
#include "msc_vo/mapping/tracking_counts.h"
#include "msc_vo/matching/frame_matches.h"
#include "msc_vo/self_calibration/recent_pairs.h"
#include "msc_vo/sensor/recorded_image.h"
#include "msc_vo/structure/axis_evidence.h"

namespace msc_vo {

/// Plain data that tracking passes to the mapper for each keyframe; shared parts are immutable.
struct KeyframePacket {
  KeyframeId id = kNoId;  ///< of the keyframe; kNoId: the next one of the map
  std::shared_ptr<const Frame> frame;
  /// kNoId: the first keyframe of a map, for which cam_from_reference is cam_from_world.
  KeyframeId reference = kNoId;
  Rigid3 cam_from_reference;
  /// The keyframe begins a new map. The map before it becomes inactive if `keeps_last_map`, and is
  /// discarded otherwise.
  bool begins_map = false;
  bool keeps_last_map = true;
  std::optional<LastTrackedPose> last_tracked;  ///< in that map
  FrameMatches matches;                         ///< with landmarks of the map
  /// Of the pose in the map, in the camera frame (CameraCovariance()).
  PoseCovariance covariance = PoseCovariance::Zero();
  std::optional<Revisit> revisit;  ///< if it shows another part of the map
  /// Seconds since the image before `frame`, keyframe or not; none if it is the first image.
  std::optional<double> frame_interval;
  KeyframeId last_keyframe = kNoId;  ///< of the packet before
  /// Velocity at `last_keyframe`, from the frames before and after it; none if unknown.
  std::optional<CameraVelocity> last_velocity;
  /// Normals of visible surfaces, camera frame; empty if the map already has Manhattan axes.
  std::vector<AxisEvidence> normals;
  /// For self-calibration, until it has settled: the image of `frame`, and images since the last
  /// packet. Null: the keyframe takes no part in it.
  std::shared_ptr<const RecordedImage> image;
  std::vector<CalibrationImage> calibration_images;
  /// Over all frames since the last packet, including this one.
  PerKind<TrackingCounts> counts;
};

}  // namespace msc_vo
