// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/diagnosis/finding.h"

namespace msc_vo {

/// A value with its standard deviation.
struct Estimate {
  double value = 0.0;
  double sigma = 0.0;
};

/// Calibration as the motion of points shows it, relative to the calibration that is given.
struct CalibrationEstimate {
  double given_focal_length = 0.0;  ///< pixels
  Estimate focal_length;            ///< pixels
  double given_cx = 0.0;            ///< pixels
  Estimate cx;                      ///< pixels
  double given_cy = 0.0;            ///< pixels
  Estimate cy;                      ///< pixels
  Estimate k1;                      ///< radial distortion beyond the lens that is given
};

/// Compares a calibration with its estimate: a warning where the two differ by more than three
/// standard deviations and by more than the errors that remain in a well calibrated RGB-D camera.
void AddCalibrationFindings(const CalibrationEstimate& estimate, int width, Findings* findings);

}  // namespace msc_vo
