// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/self_calibration/sensor_calibration.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "tests/support/simulated_camera.h"
#include <gtest/gtest.h>

namespace msc_vo {
namespace {

using S = SensorCorrection;

// A calibration of simulated images, which it keeps.
struct Calibrated {
  Calibrated(const S::Vector& truth, unsigned seed, int num_views = 24, int num_sequences = 1)
      : sequences(num_sequences, SimulatedCamera(truth, seed).Sequence(num_views)),
        calibration(kGiven, LensDistortion(), sequences),
        result(calibration.MakeEstimate()),
        estimate(result.selected) {}

  std::vector<CalibrationSequence> sequences;
  SensorCalibration calibration;
  SensorCalibration::Estimate result;
  CorrectionEstimate estimate;
};

void ExpectNear(const CorrectionEstimate& estimate, const S::Vector& truth, S::Index index,
                double tolerance) {
  EXPECT_NEAR(estimate.correction(index), truth(index), tolerance) << index;
  EXPECT_LT(std::abs(estimate.correction(index) - truth(index)), 3.0 * estimate.sigma(index))
      << index;
}

TEST(SensorCalibration, KeepsARightCalibration) {
  for (const unsigned seed : {1U, 2U, 3U}) {
    const Calibrated calibrated(S::Vector::Zero(), seed);
    EXPECT_GT(calibrated.calibration.num_pairs(), 50);
    EXPECT_FALSE(calibrated.estimate.IsCorrected()) << seed;
  }
}

TEST(SensorCalibration, FindsTheFocalLength) {
  for (const double error : {0.03, -0.03}) {
    S::Vector truth = S::Vector::Zero();
    truth(S::kFocalLength) = error;
    const CorrectionEstimate estimate = Calibrated(truth, 4, 60).estimate;
    EXPECT_EQ(estimate.is_corrected, (CorrectionGroups{true, false, false, false}))
        << "log odds " << estimate.log_odds[0];
    ExpectNear(estimate, truth, S::kFocalLength, 0.005);
  }
}

double MedianError(const std::vector<PairResidual>& residuals) {
  std::vector<double> errors;
  for (const PairResidual& residual : residuals) errors.push_back(residual.reprojection.norm());
  std::sort(errors.begin(), errors.end());
  return errors.at(errors.size() / 2);
}

TEST(SensorCalibration, ResidualsFallToTheNoise) {
  S::Vector truth = S::Vector::Zero();
  truth(S::kK1) = -0.1;
  const Calibrated calibrated(truth, 6);
  EXPECT_GT(MedianError(calibrated.calibration.Residuals(S::Vector::Zero())), 1.0);
  // The median length of an error of 0.2 px in each coordinate of both images.
  EXPECT_NEAR(MedianError(calibrated.calibration.Residuals(calibrated.estimate.correction)),
              0.2 * std::sqrt(2.0) * 1.177, 0.06);
}

TEST(SensorCalibration, FindsThePrincipalPoint) {
  S::Vector truth = S::Vector::Zero();
  truth(S::kCenterX) = 8.0 * kPixel;
  truth(S::kCenterY) = -8.0 * kPixel;
  const CorrectionEstimate estimate = Calibrated(truth, 5).estimate;
  EXPECT_EQ(estimate.is_corrected, (CorrectionGroups{false, true, false, false}));
  ExpectNear(estimate, truth, S::kCenterX, kPixel);
  ExpectNear(estimate, truth, S::kCenterY, kPixel);
}

TEST(SensorCalibration, FindsTheDistortionOfTheLens) {
  S::Vector truth = S::Vector::Zero();
  truth(S::kK1) = -0.1;
  const CorrectionEstimate estimate = Calibrated(truth, 6).estimate;
  EXPECT_EQ(estimate.is_corrected, (CorrectionGroups{false, false, true, false}));
  ExpectNear(estimate, truth, S::kK1, 0.01);
}

TEST(SensorCalibration, FindsADepthCameraBesideTheColourCamera) {
  S::Vector truth = S::Vector::Zero();
  truth(S::kDepthFocalLength) = 0.1;
  truth(S::kDepthParallaxX) = -0.03;
  const CorrectionEstimate estimate = Calibrated(truth, 7).estimate;
  EXPECT_EQ(estimate.is_corrected, (CorrectionGroups{false, false, false, true}));
  // The image is read up to 32 px beside the true place; `calibrate` registers it and repeats.
  ExpectNear(estimate, truth, S::kDepthFocalLength, 0.015);
  // Shift and parallax together: the parallax alone needs a large range of depths.
  const auto shift_at_two_metres = [](const S::Vector& correction) {
    return correction(S::kDepthX) + 0.5 * correction(S::kDepthParallaxX);
  };
  EXPECT_NEAR(shift_at_two_metres(estimate.correction), shift_at_two_metres(truth), 2.0 * kPixel);
}

TEST(SensorCalibration, EstimatesWhatItKeeps) {
  // An error like that of a good calibration.
  S::Vector truth = S::Vector::Zero();
  truth(S::kCenterX) = 3.0 * kPixel;
  const Calibrated calibrated(truth, 9);
  EXPECT_FALSE(calibrated.estimate.IsCorrected());
  const double sigma = calibrated.estimate.sigma(S::kCenterX);
  EXPECT_LT(sigma, 2.0 * kPixel);
  EXPECT_NEAR(calibrated.result.unrestricted(S::kCenterX), truth(S::kCenterX), 3.0 * sigma);
  EXPECT_GT(calibrated.result.unrestricted(S::kCenterX), 0.0);
}

TEST(SensorCalibration, WeighsEachSequenceByItsImages) {
  const Calibrated one(S::Vector::Zero(), 2), two(S::Vector::Zero(), 2, 24, 2);
  EXPECT_EQ(two.calibration.num_pairs(), 2 * one.calibration.num_pairs());
  EXPECT_EQ(two.calibration.num_pairs(1), one.calibration.num_pairs());
  EXPECT_EQ(two.calibration.num_views(), 2 * one.calibration.num_views());
  // Twice the information, where the prior has no part in it.
  EXPECT_NEAR(one.estimate.sigma(S::kCenterX) / two.estimate.sigma(S::kCenterX), std::sqrt(2.0),
              0.1);
}

TEST(SensorCalibration, PairsImagesWithinTheFieldOfView) {
  SimulatedCamera camera(S::Vector::Zero(), 8);
  const Rigid3 turn(ExpSO3(Eigen::Vector3d(0.0, 0.6, 0.0)), Eigen::Vector3d::Zero());
  const std::vector<CalibrationSequence> turned = {{camera.View(Rigid3()), camera.View(turn)}};
  EXPECT_EQ(SensorCalibration(kGiven, LensDistortion(), turned).num_pairs(), 1);
  PinholeCamera narrow = kGiven;
  narrow.fx = narrow.fy = 2.0 * kGiven.fx;
  EXPECT_EQ(SensorCalibration(narrow, LensDistortion(), turned).num_pairs(), 0);
}

TEST(SensorCalibration, LeavesAloneWhatAPathCannotTell) {
  // Two equal images: without motion, every calibration makes the scene rigid.
  S::Vector truth = S::Vector::Zero();
  truth(S::kFocalLength) = 0.03;
  SimulatedCamera camera(truth, 8);
  const std::vector<CalibrationSequence> still = {{camera.View(Rigid3()), camera.View(Rigid3())}};
  const CorrectionEstimate estimate =
      SensorCalibration(kGiven, LensDistortion(), still).MakeEstimate().selected;
  EXPECT_FALSE(estimate.IsCorrected());
  EXPECT_GT(estimate.sigma(S::kFocalLength), 0.9 * WrongCalibrationSigma()(S::kFocalLength));
}

}  // namespace
}  // namespace msc_vo
