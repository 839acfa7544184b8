// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <array>
#include <optional>
#include <string>

#include "msc_vo/datasets/calibration.h"
#include "msc_vo/report/calibration_plots.h"
#include "msc_vo/self_calibration/calibration_evidence.h"

namespace msc_vo {

/// Readout time of a rolling shutter that the runs have found.
struct ReadoutEstimate {
  double seconds = 0.0;
  double sigma = 0.0;  ///< seconds
};

/// A calibration before and after self-calibration.
struct CalibrationReport {
  Calibration given;
  Calibration used;                    ///< the result: given values, and those that are corrected
  CorrectionGroups is_corrected = {};  ///< groups of `used` that are not as given
  /// Estimates of the last round: of the groups that `refinement` corrects, and of all groups if
  /// every group were wrong.
  Calibration estimated;
  Calibration unrestricted;
  CorrectionEstimate refinement;  ///< of the last round; its sigmas are those of the estimates
  std::optional<ReadoutEstimate> readout;  ///< none: given or not found
  /// Of each CorrectionGroup to be wrong in `given`, see CorrectionEstimate: of the first round.
  std::array<double, kNumCorrectionGroups> log_odds = {};
  int num_views = 0;  ///< of the first round
  int num_pairs = 0;
  bool edges_contradict = false;  ///< depth edges refuse a correction of the registration
  /// Why `estimated` cannot be used, with the fix; empty: it can.
  std::string problem;
  /// With the given calibration: of the first round. With the one that is used: of the last round,
  /// whose images were tracked with the estimate of the round before, so that the points are not
  /// the same.
  CalibrationResiduals residuals;
};

/// Table of the values, their standard deviations, and the verdict on each part.
std::string FormatCalibrationTable(const CalibrationReport& report);

/// The same as JSON.
std::string FormatCalibrationJson(const CalibrationReport& report);

/// The numbers and plots of the residuals before and after.
PlotPage CalibrationPage(const CalibrationReport& report, const std::string& title);

}  // namespace msc_vo
