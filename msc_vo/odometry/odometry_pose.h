// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>

#include "msc_vo/geometry/pose_covariance.h"
#include "msc_vo/geometry/rigid3.h"
#include "msc_vo/map/path_covariance.h"

namespace msc_vo {

struct TrackedFrame;

/// Integrates the motion between images to a pose that never jumps
/// (FrameResult::cam_from_odometry). Every motion is measured in one map, so that changes of the
/// map are not part of it.
class OdometryPose {
 public:
  /// Adds the next tracked frame. After frames whose pose was predicted or lost, the camera moves
  /// on from the last of these, with its mean velocity over the gap. It rests during a jump from
  /// one image to the next (TrackedFrame::is_jump).
  void Add(const TrackedFrame& tracked);

  /// The pose of the last frame; identity before the first segment.
  const Rigid3& cam_from_odometry() const { return cam_from_odometry_; }
  /// Its covariance (FrameResult::odometry_covariance): the drift of all keyframes so far, the
  /// motion that was missed in gaps, and the tracked pose itself.
  const std::optional<PoseCovariance>& covariance() const { return covariance_; }

  /// Lists the state for a checkpoint.
  template <typename Archive>
  void Serialize(Archive& archive) {
    auto& [pose, covariance, timestamp, base, base_timestamp, in_gap, has_begun, drift,
           keyframe] = *this;  // all members, or it does not compile
    archive(pose, covariance, timestamp, base, base_timestamp, in_gap, has_begun, drift, keyframe);
  }

 private:
  void AddMotion(const TrackedFrame& tracked);
  void AddCovariance(const TrackedFrame& tracked);

  Rigid3 cam_from_odometry_;
  std::optional<PoseCovariance> covariance_;
  double timestamp_ = 0.0;  // seconds, of the last frame
  // Of the frame that TrackedFrame::cam_from_last refers to.
  Rigid3 base_from_odometry_;
  double base_timestamp_ = 0.0;
  bool in_gap_ = false;     // the pose has been predicted since that frame
  bool has_begun_ = false;  // there is such a frame
  PathDrift drift_;         // up to the last keyframe; base: the odometry frame
  Rigid3 odometry_from_keyframe_;
};

}  // namespace msc_vo
