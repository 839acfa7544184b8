// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include "msc_vo/results/run_summary.h"

namespace msc_vo {

/// A number of the calibration after a run.
struct CalibratedValue {
  const char* name;  ///< "fx"
  const char* unit;  ///< "px"; may be empty
  double value = 0.0;
  double sigma = 0.0;     ///< standard deviation of the estimate; infinite if there was none
  double log_odds = 0.0;  ///< of the calibration to be wrong in the group of the value
  bool is_corrected = false;
  /// "corrected", or KeptVerdict().
  const char* verdict;
};

/// The verdict on a value that is not corrected: "kept", or "kept: not observable".
const char* KeptVerdict(bool is_observable);

/// The calibration in use at the end of a run, with the standard deviations that self-calibration
/// gives to its values.
std::vector<CalibratedValue> ListCalibratedValues(const RunSummary& summary);

/// Says that depth contradicts the images: its noise scale is at its bound, and self-calibration is
/// certain that the registration is wrong, but has not corrected it. Empty otherwise.
std::string DescribeDepthContradiction(const RunSummary& summary);

}  // namespace msc_vo
