// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include "msc_vo/diagnosis/depth_quality.h"
#include "msc_vo/diagnosis/finding.h"
#include "msc_vo/diagnosis/motion_track.h"
#include "msc_vo/geometry/timed_pose.h"

namespace msc_vo {

/// Compares the motion of the images with the ground truth: frame convention, time offset, scale
/// (that of depth in `units`) and hand-eye offset. Adds nothing if there is no ground truth. The
/// scale is not judged unless `is_calibrated`: another error of the calibration changes lengths,
/// too.
void AddGroundTruthMotionFindings(const MotionTrack& track, const std::vector<TimedPose>& truth,
                                  const DepthUnits& units, bool is_calibrated, Findings* findings);

}  // namespace msc_vo
