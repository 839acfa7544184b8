// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <array>
#include <string>

#include "msc_vo/datasets/calibration.h"
#include "msc_vo/report/calibration_plots.h"
#include "msc_vo/self_calibration/sensor_calibration.h"

namespace msc_vo {

/// A calibration before and after self-calibration.
struct CalibrationReport {
  Calibration given;
  Calibration estimated;
  /// Of each CorrectionGroup to be wrong in `given`, see CorrectionEstimate.
  std::array<double, kNumCorrectionGroups> log_odds = {};
  CorrectionEstimate refinement;  ///< of the last round; its sigmas are those of `estimated`
  int num_views = 0;
  int num_pairs = 0;
  bool edges_contradict = false;  ///< depth edges refuse a correction of the registration
  /// With the given calibration: of the first round. With the estimated one: of the last round,
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

/// The section `camera` of a configuration, as YAML.
std::string FormatCameraYaml(const Calibration& calibration, const std::string& comment);

}  // namespace msc_vo
