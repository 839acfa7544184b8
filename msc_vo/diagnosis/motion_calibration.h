// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>

#include "msc_vo/datasets/rgbd_decoder.h"
#include "msc_vo/diagnosis/motion_track.h"
#include "msc_vo/self_calibration/calibration_evidence.h"

namespace msc_vo {

/// The calibration that the motion of the images supports, relative to the one that they were
/// tracked with.
struct MotionCalibration {
  /// Corrected are the groups that SensorCalibration accepts, and those of the colour camera that
  /// are significantly off and more likely wrong than right.
  CorrectionEstimate estimate;
  bool edges_contradict = false;  ///< depth edges refuse a correction of the registration
};

/// Estimates the calibration with SensorCalibration from the views and maps of the track, as
/// `msc_vo calibrate` does in its first round. `decoder`: of the sequence, for its calibration and
/// its depth edges. Returns std::nullopt if fewer than ten pairs of images match.
std::optional<MotionCalibration> CalibrateFromMotion(const RgbdDecoder& decoder,
                                                     const MotionTrack& track);

}  // namespace msc_vo
