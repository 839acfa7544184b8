// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <limits>

#include "msc_vo/geometry/camera_velocity.h"
#include "msc_vo/geometry/motion_limits.h"

namespace msc_vo {

/// Tells poses after a gap that the camera can hardly have reached in that time (MotionLimits).
class MotionPlausibility {
 public:
  /// Reports the mean velocity from the last frame with an estimated pose to the one at `timestamp`
  /// (seconds). `after_gap`: there are frames without a pose between both.
  void Observe(double timestamp, const CameraVelocity& velocity, bool after_gap);

  /// Questions the pose of the frame at `timestamp` for another reason.
  void Question(double timestamp);

  /// Whether the pose of a frame at `timestamp` follows a questioned one within a few seconds.
  bool IsQuestioned(double timestamp) const { return timestamp < questioned_until_; }

  /// Lists the state for a checkpoint.
  template <typename Archive>
  void Serialize(Archive& archive) {
    auto& [limits, questioned_until] = *this;  // all members, or it does not compile
    archive(limits, questioned_until);
  }

 private:
  MotionLimits limits_;
  double questioned_until_ = std::numeric_limits<double>::lowest();  // seconds
};

}  // namespace msc_vo
