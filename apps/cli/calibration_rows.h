// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/cli/calibration_report.h"

namespace msc_vo {

/// A value of a calibration before and after self-calibration.
struct CalibrationRow {
  std::string name;
  std::string key;   ///< in JSON
  std::string unit;  ///< empty: none
  std::optional<double> given = {};
  std::optional<double> estimated = {};  ///< none: not observable
  std::optional<double> sigma = {};      ///< standard deviation of `estimated`
  std::optional<double> used = {};
  std::string verdict = {};
  std::optional<CorrectionGroup> group = {};  ///< none: not corrected by groups
  /// False for the camera of depth images that are registered: it is the colour camera.
  bool is_listed = true;

  std::string NameWithUnit() const { return unit.empty() ? name : name + ", " + unit; }
};

/// All values: of the colour camera, of the depth camera, of the shutter and of the depth sensor.
std::vector<CalibrationRow> CalibrationRows(const CalibrationReport& report);

}  // namespace msc_vo
