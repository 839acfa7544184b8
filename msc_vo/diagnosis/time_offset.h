// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "msc_vo/diagnosis/motion_track.h"
#include "msc_vo/geometry/timed_pose.h"

namespace msc_vo {

/// Time offset of two trajectories.
struct TimeOffset {
  double seconds = 0.0;
  double sigma = 0.0;
  double disagreement = 0.0;  ///< median rotation error at the offset over the median rotation
};

/// Time by which the ground truth must be read later than the images say, from the rotations over
/// about a tenth of a second, within +-`reach` seconds. `truth` holds camera-in-world poses of a
/// body that `camera_from_body` turns into the camera. Returns std::nullopt if the camera rotates
/// too little.
std::optional<TimeOffset> EstimateTimeOffset(const MotionTrack& track,
                                             const std::vector<TimedPose>& truth,
                                             const Eigen::Matrix3d& camera_from_body, double reach);

}  // namespace msc_vo
