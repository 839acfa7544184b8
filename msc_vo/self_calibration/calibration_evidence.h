// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <array>
#include <vector>

#include "msc_vo/self_calibration/calibration_pair.h"

namespace msc_vo {

/// Parts of a calibration that are right or wrong together.
enum class CorrectionGroup { kFocalLength, kPrincipalPoint, kLens, kDepthRegistration };
constexpr int kNumCorrectionGroups = 4;
constexpr std::array<CorrectionGroup, 3> kColorGroups = {
    CorrectionGroup::kFocalLength, CorrectionGroup::kPrincipalPoint, CorrectionGroup::kLens};

/// Posterior odds by the pairs of images from which on a group is a candidate, about which the map
/// is asked. The largest odds for the focal length of sequences that are described well and
/// determine it are 0.1 (docs/lab/self_calibration.md).
constexpr double kCandidateOdds = 0.3;
/// Posterior odds above which a calibration is doubted: twice those before any image.
constexpr double kDoubtedOdds = 0.2;
/// Posterior odds above which a correction is accepted. Chosen by measurement, see
/// docs/lab/self_calibration.md.
constexpr double kAcceptedOdds = 20.0;

/// A set of groups: whether each CorrectionGroup belongs to it.
using CorrectionGroups = std::array<bool, kNumCorrectionGroups>;

/// Indices of the group in SensorCorrection.
const std::vector<int>& IndicesOf(CorrectionGroup group);

/// Which groups of a calibration are wrong, and by how much.
struct CorrectionEstimate {
  /// Zero in groups that are not corrected.
  SensorCorrection::Vector correction = SensorCorrection::Vector::Zero();
  /// Standard deviation of the correction; in groups that are not corrected, that of their
  /// correction if every group were wrong.
  SensorCorrection::Vector sigma = SensorCorrection::Vector::Zero();
  CorrectionGroups is_corrected = {};
  /// Logarithm of the odds that the group is wrong: best model with it over best model without it.
  std::array<double, kNumCorrectionGroups> log_odds = {};
  /// Errors of the depth sensor, SensorCorrection::kDepthOffset and kDepthBowl. They belong to no
  /// group: every model estimates them, and nothing is corrected by them.
  Eigen::Vector2d depth_errors = Eigen::Vector2d::Zero();

  bool IsCorrected() const;
};

/// Standard deviation of the parameters before a measurement if their group is wrong.
SensorCorrection::Vector WrongCalibrationSigma();

/// Whether parameter `index` of SensorCorrection is observable: its posterior standard deviation
/// `sigma` is well below the prior one.
bool IsObservable(int index, double sigma);

/// Whether a parameter of a group that is corrected, of the lens k1, differs from the given value
/// by more than three of its standard deviations.
bool IsSignificant(CorrectionGroup group, const CorrectionEstimate& estimate);

/// Estimates the corrections of the model in which exactly the groups `wrong` are wrong: those that
/// go best with the given values of the colour camera's other groups.
CorrectionEstimate EstimateCorrections(const CalibrationInformation& information,
                                       const CorrectionGroups& wrong);

/// Adds to the standard deviations of the registration, in squares, those of a good registration.
/// They stand for errors of registered depth images that the model of the sensor leaves out and
/// that all pairs of images have in common. At most those of a wrong registration are returned.
SensorCorrection::Vector WithRegistrationErrors(SensorCorrection::Vector sigma);

/// CorrectionEstimate::log_odds.
std::array<double, kNumCorrectionGroups> GroupLogOdds(const CalibrationInformation& information);

/// Compares the 16 models in which each group is either right, up to the errors of a good
/// calibration, or wrong, by their evidence. A group is wrong with a prior probability of 1/11; the
/// model is accepted if it is kAcceptedOdds times more likely than a calibration that is right, and
/// every correction IsSignificant(). Only models in which the `known_wrong` groups are wrong, and
/// the `known_right` ones right, take part.
CorrectionEstimate SelectCorrections(const CalibrationInformation& information,
                                     const CorrectionGroups& known_wrong = {},
                                     const CorrectionGroups& known_right = {});

}  // namespace msc_vo
