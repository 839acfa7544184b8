// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstddef>
#include <vector>

#include "msc_vo/self_calibration/calibration_evidence.h"
#include "msc_vo/self_calibration/calibration_pair.h"

namespace msc_vo {

/// Images of one sequence. Their poses have a common world frame.
using CalibrationSequence = std::vector<CalibrationView>;

/// Bounds of the computing time of CalibrateSensor(), for each sequence.
struct CalibrationEffort {
  size_t max_candidates = 800;  ///< pairs of images that are matched
  size_t max_pairs = 150;       ///< pairs with points in common that are used
};

/// Result of CalibrateSensor().
struct SensorCalibrationResult {
  CorrectionEstimate estimate;
  int num_views = 0;  ///< that have points in common with others
  int num_pairs = 0;
  /// Residuals of the points of all pairs with the given calibration, and with the estimate.
  std::vector<PairResidual> given_residuals;
  std::vector<PairResidual> estimated_residuals;
};

/// Self-calibration of an RGB-D camera from images of a rigid scene (not in the paper): estimates a
/// SensorCorrection from the points that pairs of images have in common, by Gauss-Newton with the
/// relative pose of each pair marginalised, and decides which parts of the calibration are wrong.
/// `camera`, `distortion`: the calibration that the frames were built with. Poses are first
/// guesses; pairs are formed within each sequence. Groups that are `known_wrong` are corrected
/// anyway, to refine an earlier correction; those that are `known_right` are not. `of_maps`: sum of
/// SelfCalibratingBundleAdjustment() over the maps of the sequences. It takes part in the decision
/// on groups that the pairs may find wrong, and refines known corrections: a map that was made with
/// a wrong calibration lacks the observations that contradict it most.
///
/// The error of an image is common to all its pairs; the information of all pairs is therefore
/// scaled to that of one pair per image.
SensorCalibrationResult CalibrateSensor(const PinholeCamera& camera,
                                        const LensDistortion& distortion,
                                        const std::vector<CalibrationSequence>& sequences,
                                        const WrongGroups& known_wrong = {},
                                        const WrongGroups& known_right = {},
                                        const CalibrationInformation& of_maps = {},
                                        const CalibrationEffort& effort = {});

}  // namespace msc_vo
