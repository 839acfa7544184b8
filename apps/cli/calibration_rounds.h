// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/cli/calibration_report.h"
#include "apps/cli/interrupt_guard.h"
#include "apps/cli/sequence_run.h"
#include "msc_vo/config/option_list.h"
#include "msc_vo/datasets/rgbd_decoder.h"
#include "msc_vo/self_calibration/sensor_calibration.h"

namespace msc_vo {

/// Calibrates a camera from sequences: each round runs the odometry with the calibration of the
/// round before and estimates a correction from its images.
class CalibrationRounds {
 public:
  /// The sequences have the same calibration. `interrupt` must outlive the object.
  CalibrationRounds(std::vector<RgbdDecoder> sequences, const Configuration& configuration,
                    const RunArguments& run, const InterruptGuard& interrupt);

  /// Runs up to three rounds. Prints why if the exit code is not kExitSuccess; there is no report
  /// then. Throws std::runtime_error naming the sequence if its run fails, or if too few of its
  /// images have points in common.
  ExitCode Run();

  const CalibrationReport& report() const { return report_; }

 private:
  // Runs the odometry on every sequence, selects images for the calibration, and adjusts the maps.
  ExitCode Track(int round);
  // Estimates a correction from the tracked images. Returns false if it was the last round.
  bool Estimate(int round);
  // The estimate, without a correction of the registration that depth edges contradict.
  SensorCalibration::Estimate MakeEstimate(const SensorCalibration& calibration);
  // Whether depth edges lie on image edges at least as well with the corrected calibration.
  bool EdgesAgree(const Calibration& corrected) const;
  // Throws std::runtime_error naming the sequence without pairs, if there is one.
  void RequirePairs(const SensorCalibration& calibration) const;
  // The medians and plots show the residuals at a correction of the present calibration.
  std::vector<CalibrationResidual> Residuals(const SensorCalibration& calibration,
                                             const SensorCorrection::Vector& correction) const;

  std::vector<RgbdDecoder> sequences_;
  Configuration configuration_;
  RunArguments run_;
  const InterruptGuard& interrupt_;
  CalibrationReport report_;
  CorrectionGroups wrong_ = {};                                             // corrected from now on
  CorrectionGroups right_ = {};                                             // not to be corrected
  SensorCorrection::Vector correction_ = SensorCorrection::Vector::Zero();  // sum of all rounds
  // The unrestricted correction of the round in which depth edges contradicted it.
  std::optional<SensorCorrection::Vector> contradicted_;
  // Of the present round.
  std::vector<CalibrationSequence> views_;
  CalibrationInformation of_maps_;
};

}  // namespace msc_vo
