// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/geometry/rigid3.h"

namespace msc_vo {

struct TrackedFrame;

/// Integrates the motion between images to a pose that never jumps
/// (FrameResult::cam_from_odometry). Every motion is measured in one map, so that changes of the
/// map are not part of it.
class OdometryPose {
 public:
  /// Adds the next tracked frame. After frames whose pose was predicted or lost, the camera moves
  /// on from the last of these, with its mean velocity over the gap.
  void Add(const TrackedFrame& tracked);

  /// The pose of the last frame; identity before the first segment.
  const Rigid3& cam_from_odometry() const { return cam_from_odometry_; }

  /// Lists the state for a checkpoint.
  template <typename Archive>
  void Serialize(Archive& archive) {
    auto& [pose, timestamp, base, base_timestamp, in_gap] =
        *this;  // all members, or it does not compile
    archive(pose, timestamp, base, base_timestamp, in_gap);
  }

 private:
  Rigid3 cam_from_odometry_;
  double timestamp_ = 0.0;  // seconds, of the last frame
  // Of the frame that TrackedFrame::cam_from_last refers to.
  Rigid3 base_from_odometry_;
  double base_timestamp_ = 0.0;
  bool in_gap_ = false;  // the pose has been predicted since that frame
};

}  // namespace msc_vo
