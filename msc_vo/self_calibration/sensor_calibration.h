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

/// Bounds of the computing time of a SensorCalibration, for each sequence.
struct CalibrationEffort {
  size_t max_candidates = 800;  ///< pairs of images that are matched
  size_t max_pairs = 150;       ///< pairs with points in common that are used
};

/// Self-calibration of an RGB-D camera from images of a rigid scene (not in the paper): estimates a
/// SensorCorrection from the points that pairs of images have in common, by Gauss-Newton with the
/// relative pose of each pair marginalised, and decides which parts of the calibration are wrong.
class SensorCalibration {
 public:
  struct Estimate {
    CorrectionEstimate selected;  ///< corrects the groups that are wrong
    /// The correction if every group were wrong, by the pairs alone. Its standard deviations are
    /// `selected.sigma` in the groups that are not corrected.
    SensorCorrection::Vector unrestricted = SensorCorrection::Vector::Zero();
  };

  /// Matches pairs of images within each sequence, which must outlive the object. `camera`,
  /// `distortion`: the calibration that the frames were built with. Poses are first guesses.
  SensorCalibration(const PinholeCamera& camera, const LensDistortion& distortion,
                    const std::vector<CalibrationSequence>& sequences,
                    const CalibrationEffort& effort = {});

  /// Number of images that have points in common with others, and of pairs of them.
  int num_views() const;
  int num_pairs() const;
  int num_pairs(size_t sequence) const;

  /// Groups that are `known_wrong` are corrected anyway, to refine an earlier correction; those
  /// that are `known_right` are not. `of_maps`: sum of SelfCalibratingBundleAdjustment() over the
  /// maps of the sequences. It takes part in the decision on groups that the pairs may find wrong,
  /// and refines known corrections: a map that was made with a wrong calibration lacks the
  /// observations that contradict it most.
  ///
  /// The error of an image is common to all its pairs; the information of the pairs of a sequence
  /// is therefore scaled to that of one pair per image.
  Estimate MakeEstimate(const CorrectionGroups& known_wrong = {},
                        const CorrectionGroups& known_right = {},
                        const CalibrationInformation& of_maps = {}) const;

  /// Residuals of the points of all pairs.
  std::vector<PairResidual> Residuals(const SensorCorrection::Vector& correction) const;

 private:
  // The pairs of one sequence.
  struct Pairs {
    std::vector<CalibrationPair> pairs;
    int num_views = 0;
  };

  static Pairs Match(const CorrectedCamera& camera, const CalibrationSequence& views,
                     const CalibrationEffort& effort);
  static CalibrationInformation SumOf(const Pairs& pairs,
                                      const SensorCorrection::Vector& correction);
  CalibrationInformation Sum(const SensorCorrection::Vector& correction) const;
  // Gauss-Newton for the model in which exactly the groups `wrong` are corrected. The errors of
  // maps count as independent, so that the standard deviations are those of the pairs alone.
  CorrectionEstimate Iterate(const CalibrationInformation& of_maps, const CorrectionGroups& wrong,
                             SensorCorrection::Vector at) const;

  std::vector<Pairs> sequences_;
};

}  // namespace msc_vo
