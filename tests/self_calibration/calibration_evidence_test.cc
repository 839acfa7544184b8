// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/self_calibration/calibration_evidence.h"

#include <cmath>

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
  EXPECT_EQ(estimate.is_corrected, (CorrectionGroups{true, false, false, false}));
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

// Six parameters that are each off by two standard deviations make a group likely wrong.
TEST(CalibrationEvidence, RefusesACorrectionBelowThreeSigmas) {
  const auto make = [](double sigmas) {
    std::vector<std::pair<S::Index, std::pair<double, double>>> all;
    for (const int i : IndicesOf(CorrectionGroup::kDepthRegistration)) {
      const double sigma = 0.3 * WrongCalibrationSigma()(i);
      all.push_back({static_cast<S::Index>(i), {sigmas * sigma, sigma}});
    }
    return SelectCorrections(Measured(all));
  };
  const CorrectionEstimate refused = make(2.9), accepted = make(4.0);
  EXPECT_GT(refused.log_odds[3], std::log(kAcceptedOdds));
  EXPECT_FALSE(refused.IsCorrected());
  EXPECT_TRUE(accepted.is_corrected[3]);
  EXPECT_TRUE(IsSignificant(CorrectionGroup::kDepthRegistration, accepted));
}

TEST(CalibrationEvidence, IsSignificantIfOneParameterIs) {
  CorrectionEstimate estimate;
  estimate.sigma.setConstant(0.01);
  estimate.correction(S::kCenterX) = 0.029;
  EXPECT_FALSE(IsSignificant(CorrectionGroup::kPrincipalPoint, estimate));
  estimate.correction(S::kCenterY) = -0.031;
  EXPECT_TRUE(IsSignificant(CorrectionGroup::kPrincipalPoint, estimate));
  EXPECT_FALSE(IsSignificant(CorrectionGroup::kFocalLength, estimate));
}

// A lens that is not in the model changes k2 first.
TEST(CalibrationEvidence, JudgesALensByK1) {
  CorrectionEstimate estimate;
  estimate.sigma.setConstant(0.01);
  estimate.correction(S::kK2) = 0.1;
  estimate.correction(S::kK1) = 0.029;
  EXPECT_FALSE(IsSignificant(CorrectionGroup::kLens, estimate));
  estimate.correction(S::kK1) = -0.031;
  EXPECT_TRUE(IsSignificant(CorrectionGroup::kLens, estimate));
}

TEST(CalibrationEvidence, LeavesUnobservableParametersAtThePrior) {
  const auto estimate = SelectCorrections(Measured({{S::kFocalLength, {0.03, 0.002}}}));
  EXPECT_NEAR(estimate.sigma(S::kK1), WrongCalibrationSigma()(S::kK1), 1e-12);
}

TEST(CalibrationEvidence, ObeysWhatIsKnown) {
  const auto information = Measured({{S::kFocalLength, {0.03, 0.002}}, {S::kK1, {0.02, 0.01}}});
  const CorrectionGroups focal = {true, false, false, false}, lens = {false, false, true, false};
  EXPECT_EQ(SelectCorrections(information, lens).is_corrected,
            (CorrectionGroups{true, false, true, false}));
  EXPECT_FALSE(SelectCorrections(information, {}, focal).IsCorrected());
}

TEST(CalibrationEvidence, CorrectsWhatGoesBestWithTheGivenValuesThatAreKept) {
  // A principal point that is off by 0.03, which the images tell only together with the focal
  // length: 0.028 goes best with a focal length that is 0.4 % off, which is kept.
  auto information = Measured({{S::kCenterX, {0.028, 0.001}}, {S::kFocalLength, {0.004, 0.002}}});
  const double coupling = -0.5 * std::sqrt(information.matrix(S::kCenterX, S::kCenterX) *
                                           information.matrix(S::kFocalLength, S::kFocalLength));
  information.matrix(S::kCenterX, S::kFocalLength) = coupling;
  information.matrix(S::kFocalLength, S::kCenterX) = coupling;
  information.vector(S::kCenterX) += coupling * 0.004;
  information.vector(S::kFocalLength) += coupling * 0.028;
  const CorrectionGroups center = {false, true, false, false};
  const CorrectionEstimate estimate = EstimateCorrections(information, center);
  const double held =
      information.vector(S::kCenterX) / information.matrix(S::kCenterX, S::kCenterX);
  EXPECT_NEAR(estimate.correction(S::kCenterX), held, 1e-4);
  EXPECT_EQ(estimate.correction(S::kFocalLength), 0.0);
  // The given value may be somewhat wrong.
  EXPECT_GT(estimate.sigma(S::kCenterX), 0.00105);
}

TEST(CalibrationEvidence, EstimatesTheErrorsOfTheDepthSensorInEveryModel) {
  const auto information =
      Measured({{S::kDepthOffset, {0.004, 0.0005}}, {S::kDepthBowl, {0.03, 0.005}}});
  const CorrectionEstimate estimate = SelectCorrections(information);
  EXPECT_FALSE(estimate.IsCorrected());
  EXPECT_EQ(estimate.correction, S::Vector(S::Vector::Zero()));
  EXPECT_NEAR(estimate.depth_errors.x(), 0.004, 2e-4);
  EXPECT_NEAR(estimate.depth_errors.y(), 0.03, 1e-3);
  EXPECT_NEAR(estimate.sigma(S::kDepthOffset), 0.0005, 1e-5);
}

}  // namespace
}  // namespace msc_vo
