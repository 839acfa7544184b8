// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/self_calibration/calibration_evidence.h"

#include <gtest/gtest.h>

namespace msc_vo {
namespace {

using S = SensorCorrection;

// Information about single parameters: estimates with their standard deviations.
CalibrationInformation Measured(
    const std::vector<std::pair<S::Index, std::pair<double, double>>>& all) {
  CalibrationInformation information;
  for (const auto& [index, estimate] : all) {
    const double weight = 1.0 / (estimate.second * estimate.second);
    information.matrix(index, index) = weight;
    information.vector(index) = weight * estimate.first;
  }
  return information;
}

TEST(CalibrationEvidence, AcceptsACorrectionWithStrongEvidence) {
  const auto estimate = SelectCorrections(Measured(
      {{S::kFocalLength, {0.03, 0.002}}, {S::kCenterX, {0.001, 0.001}}, {S::kK1, {0.0, 0.01}}}));
  EXPECT_EQ(estimate.is_corrected, (WrongGroups{true, false, false, false}));
  EXPECT_NEAR(estimate.correction(S::kFocalLength), 0.03, 0.001);
  EXPECT_NEAR(estimate.sigma(S::kFocalLength), 0.002, 1e-4);
  EXPECT_EQ(estimate.correction(S::kCenterX), 0.0);
  EXPECT_GT(estimate.log_odds[0], 5.0);
  EXPECT_LT(estimate.log_odds[1], 0.0);
}

TEST(CalibrationEvidence, KeepsWhatIsWithinTheErrorsOfAGoodCalibration) {
  // Significant, but a good calibration may be as far off.
  EXPECT_FALSE(SelectCorrections(Measured({{S::kFocalLength, {0.006, 0.0002}}})).IsCorrected());
  // Far off, but not significant.
  EXPECT_FALSE(SelectCorrections(Measured({{S::kFocalLength, {0.03, 0.02}}})).IsCorrected());
  EXPECT_FALSE(SelectCorrections(CalibrationInformation()).IsCorrected());
}

TEST(CalibrationEvidence, LeavesUnobservableParametersAtThePrior) {
  const auto estimate = SelectCorrections(Measured({{S::kFocalLength, {0.03, 0.002}}}));
  EXPECT_NEAR(estimate.sigma(S::kK1), WrongCalibrationSigma()(S::kK1), 1e-12);
}

TEST(CalibrationEvidence, ObeysWhatIsKnown) {
  const auto information = Measured({{S::kFocalLength, {0.03, 0.002}}, {S::kK1, {0.02, 0.01}}});
  const WrongGroups focal = {true, false, false, false}, lens = {false, false, true, false};
  EXPECT_EQ(SelectCorrections(information, lens).is_corrected,
            (WrongGroups{true, false, true, false}));
  EXPECT_FALSE(SelectCorrections(information, {}, focal).IsCorrected());
}

}  // namespace
}  // namespace msc_vo
