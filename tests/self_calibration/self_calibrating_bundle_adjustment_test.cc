// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/self_calibration/self_calibrating_bundle_adjustment.h"

#include <memory>

#include "tests/support/simulated_camera.h"
#include <gtest/gtest.h>

#include "msc_vo/self_calibration/calibration_evidence.h"
#include "msc_vo/self_calibration/pair_view.h"

namespace msc_vo {
namespace {

using S = SensorCorrection;

constexpr CorrectionGroups kColor = {true, true, true, false};

// The map of a camera whose calibration differs from the given one by `truth`, as the given one
// sees it: poses are right, points are where their first observation measures them.
void FillMap(SimulatedCamera* camera, int num_keyframes, Map* map) {
  LandmarksByDescriptor landmarks;
  for (int k = 0; k < num_keyframes; ++k) {
    const Rigid3 cam_from_world = SimulatedCamera::PoseOf(k);
    const auto [frame, depth] = camera->Record(cam_from_world);
    Observe(map->AddKeyframe(frame, cam_from_world), &landmarks, map);
  }
}

class SelfCalibratingBundleAdjustmentTest : public testing::Test {
 protected:
  CorrectionEstimate Estimate(const S::Vector& truth, int num_keyframes) {
    SimulatedCamera camera(truth, 3);
    Map map;
    FillMap(&camera, num_keyframes, &map);
    const auto information =
        SelfCalibratingBundleAdjustment(*camera.given(), map, S::Vector::Zero());
    EXPECT_TRUE(information);
    return information ? EstimateCorrections(*information, kColor) : CorrectionEstimate();
  }
};

TEST_F(SelfCalibratingBundleAdjustmentTest, FindsTheErrorsOfTheColorCamera) {
  S::Vector truth = S::Vector::Zero();
  truth(S::kFocalLength) = -0.03;
  truth(S::kCenterX) = 5.0 * kPixel;
  truth(S::kCenterY) = -4.0 * kPixel;
  truth(S::kK1) = -0.1;
  const CorrectionEstimate estimate = Estimate(truth, 12);
  for (const int i : {S::kFocalLength, S::kCenterX, S::kCenterY, S::kK1}) {
    EXPECT_NEAR(estimate.correction(i), truth(i), 4.0 * estimate.sigma(i)) << i;
  }
  EXPECT_LT(estimate.sigma(S::kFocalLength), 0.003);
  EXPECT_LT(estimate.sigma(S::kCenterX), kPixel);
}

TEST_F(SelfCalibratingBundleAdjustmentTest, IsNotMisledByDepthThatIsNotRegistered) {
  S::Vector truth = S::Vector::Zero();
  truth(S::kFocalLength) = -0.03;
  truth(S::kDepthFocalLength) = 0.05;
  truth(S::kDepthX) = 6.0 * kPixel;
  const CorrectionEstimate estimate = Estimate(truth, 12);
  EXPECT_NEAR(estimate.correction(S::kFocalLength), -0.03, 0.005);
}

TEST_F(SelfCalibratingBundleAdjustmentTest, TellsNothingOfDepth) {
  const CorrectionEstimate estimate = Estimate(S::Vector::Zero(), 8);
  for (const int i : IndicesOf(CorrectionGroup::kDepthRegistration)) {
    EXPECT_NEAR(estimate.sigma(i), WrongCalibrationSigma()(i), 0.01 * WrongCalibrationSigma()(i));
  }
}

// Its points count as one with the common error, so that the standard deviations do not fall below
// what that leaves.
TEST_F(SelfCalibratingBundleAdjustmentTest, TellsTheInformationOfTheMeanImage) {
  constexpr int kNumKeyframes = 8;
  SimulatedCamera camera(S::Vector::Zero(), 3);
  Map map;
  FillMap(&camera, kNumKeyframes, &map);
  double sum = 0.0;
  for (const auto& [id, point] : map.points()) {
    if (point.observations.size() < 2) continue;
    for (const Observation& observation : point.observations) {
      const double sigma =
          map.FindKeyframe(observation.keyframe)->frame->points[observation.feature].sigma *
          point.noise;
      sum += 1.0 / (sigma * sigma);
    }
  }
  const auto information = SelfCalibratingBundleAdjustment(*camera.given(), map, S::Vector::Zero());
  ASSERT_TRUE(information);
  EXPECT_GT(information->point_information, 0.9 * sum / kNumKeyframes);
  EXPECT_LE(information->point_information, (1.0 + 1e-9) * sum / kNumKeyframes);
  const double variance = MapCommonVariance(kGiven);
  EXPECT_GT(variance * information->point_information, 1.0);
  const CorrectionEstimate independent = EstimateCorrections(*information, kColor);
  const CorrectionEstimate common =
      EstimateCorrections(WithCommonError(*information, variance), kColor);
  EXPECT_GT(common.sigma(S::kFocalLength), 1.4 * independent.sigma(S::kFocalLength));
}

TEST_F(SelfCalibratingBundleAdjustmentTest, LeavesObservationsBehindTheCameraOut) {
  SimulatedCamera camera(S::Vector::Zero(), 3);
  Map map;
  FillMap(&camera, 6, &map);
  const auto& [id, point] = *map.points().begin();
  map.SetGeometry<PointLandmark>(id,
                                 map.CamFromWorld(point.observations.front().keyframe).Inverse() *
                                     Eigen::Vector3d(0.0, 0.0, -1.0));
  EXPECT_TRUE(SelfCalibratingBundleAdjustment(*camera.given(), map, S::Vector::Zero()));
}

// Keyframes of earlier sessions, whose lens may be unknown, observe the same points.
TEST_F(SelfCalibratingBundleAdjustmentTest, LeavesEarlierSessionsOut) {
  S::Vector truth = S::Vector::Zero();
  truth(S::kFocalLength) = -0.03;
  Map map;
  LandmarksByDescriptor landmarks;
  SimulatedCamera other(S::Vector::Zero(), 3);
  SimulatedCamera camera(truth, 3);
  for (int k = 0; k < 12; ++k) {
    const Rigid3 cam_from_world = SimulatedCamera::PoseOf(k);
    const auto [recorded, depth] = (k < 4 ? other : camera).Record(cam_from_world);
    if (k == 4) map.BeginSession();
    const auto frame = std::make_shared<Frame>(*recorded);
    if (k < 4) frame->intrinsics = nullptr;
    Observe(map.AddKeyframe(frame, cam_from_world), &landmarks, &map);
  }
  const auto information = SelfCalibratingBundleAdjustment(*camera.given(), map, S::Vector::Zero());
  ASSERT_TRUE(information);
  EXPECT_NEAR(EstimateCorrections(*information, kColor).correction(S::kFocalLength), -0.03, 0.005);
}

TEST_F(SelfCalibratingBundleAdjustmentTest, IsTheSameEachTime) {
  S::Vector truth = S::Vector::Zero();
  truth(S::kFocalLength) = 0.02;
  EXPECT_EQ(Estimate(truth, 6).correction, Estimate(truth, 6).correction);
}

TEST_F(SelfCalibratingBundleAdjustmentTest, NeedsObservations) {
  SimulatedCamera camera(S::Vector::Zero(), 3);
  Map map;
  EXPECT_FALSE(SelfCalibratingBundleAdjustment(*camera.given(), map, S::Vector::Zero()));
  FillMap(&camera, 1, &map);
  EXPECT_FALSE(SelfCalibratingBundleAdjustment(*camera.given(), map, S::Vector::Zero()));
}

}  // namespace
}  // namespace msc_vo
