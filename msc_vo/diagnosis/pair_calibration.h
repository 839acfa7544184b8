// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>

#include "msc_vo/camera/pinhole_camera.h"
#include "msc_vo/diagnosis/calibration_findings.h"
#include "msc_vo/diagnosis/motion_track.h"

namespace msc_vo {

/// Estimates focal length, principal point and radial distortion from the rigidity of the scene: as
/// corrections of `camera` that minimise the errors of matched points (reprojection and depth in
/// the second image) over all pairs, together with the relative pose of each pair. Standard
/// deviations come from the disagreement of groups of pairs, so they contain common errors of the
/// points of a pair. Returns std::nullopt if there are fewer than eight pairs.
std::optional<CalibrationEstimate> EstimatePairCalibration(const PinholeCamera& camera,
                                                           const MotionTrack& track);

}  // namespace msc_vo
