// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/self_calibration/calibration_estimator.h"

#include <memory>

#include "tests/support/simulated_camera.h"
#include <gtest/gtest.h>

#include "msc_vo/frame/frame_intrinsics.h"
#include "msc_vo/self_calibration/keyframe_frames.h"

namespace msc_vo {
namespace {

using S = SensorCorrection;

// A run whose keyframes have the given poses, with landmarks or without.
class SimulatedRun {
 public:
  explicit SimulatedRun(const S::Vector& truth, bool has_landmarks = false)
      : has_landmarks_(has_landmarks), camera_(truth, 1), estimator_(camera_.given()) {}

  // Adds a keyframe. Returns true if the calibration in use has changed.
  bool Add(const Rigid3& cam_from_world) {
    const auto [frame, depth] = camera_.Record(cam_from_world);
    const KeyframeId id = map_.AddKeyframe(frame, cam_from_world);
    if (has_landmarks_) Observe(id, &landmarks_, &map_);
    ChangeKeyframeIntrinsics(
        [this](KeyframeId, const std::shared_ptr<const Frame>& old_frame) {
          return ChangeIntrinsics(old_frame, estimator_.present());
        },
        &map_);
    const cv::Mat gray(depth.size(), CV_8UC1, cv::Scalar(128));  // without edges
    return estimator_.Update(
        map_, id, std::make_shared<RecordedImage>(gray, depth, DepthSensor::kStructuredLight), {},
        0.0);
  }
  void AddKeyframes(int count) {
    for (int i = 0; i < count; ++i) num_changes_ += Add(SimulatedCamera::PoseOf(i)) ? 1 : 0;
  }

  void SetReadoutTime(double readout_time) { estimator_.SetReadoutTime(readout_time); }

  int num_changes() const { return num_changes_; }
  const SimulatedCamera& camera() const { return camera_; }
  const CalibrationEstimator& estimator() const { return estimator_; }

 private:
  bool has_landmarks_;
  SimulatedCamera camera_;
  CalibrationEstimator estimator_;
  LandmarksByDescriptor landmarks_;
  Map map_;
  int num_changes_ = 0;
};

TEST(CalibrationEstimator, KeepsARightCalibration) {
  SimulatedRun run(S::Vector::Zero());
  run.AddKeyframes(14);
  EXPECT_EQ(run.num_changes(), 0);
  EXPECT_EQ(run.estimator().present(), run.camera().given());
  EXPECT_FALSE(run.estimator().estimate().IsCorrected());
  EXPECT_LT(run.estimator().estimate().sigma(S::kFocalLength),
            0.5 * WrongCalibrationSigma()(S::kFocalLength));
}

TEST(CalibrationEstimator, AcceptsAnotherFocalLengthOnce) {
  S::Vector truth = S::Vector::Zero();
  truth(S::kFocalLength) = -0.05;
  SimulatedRun run(truth);
  run.AddKeyframes(40);
  const CorrectionEstimate& estimate = run.estimator().estimate();
  EXPECT_TRUE(estimate.is_corrected[0]);
  EXPECT_FALSE(estimate.is_corrected[3]);
  EXPECT_GE(run.num_changes(), 1);
  EXPECT_LE(run.num_changes(), 3);
  EXPECT_NEAR(estimate.correction(S::kFocalLength), -0.05, 0.005);
  EXPECT_NEAR(run.estimator().present()->camera.fx, std::exp(-0.05) * kGiven.fx, 0.01 * kGiven.fx);
}

TEST(CalibrationEstimator, RefinesACorrectionByTheMap) {
  S::Vector truth = S::Vector::Zero();
  truth(S::kFocalLength) = -0.03;
  SimulatedRun run(truth, true);
  run.AddKeyframes(20);
  const CorrectionEstimate& estimate = run.estimator().estimate();
  EXPECT_TRUE(estimate.is_corrected[0]);
  EXPECT_FALSE(estimate.is_corrected[1] || estimate.is_corrected[2] || estimate.is_corrected[3]);
  EXPECT_NEAR(estimate.correction(S::kFocalLength), -0.03, 0.002);
  EXPECT_LE(run.num_changes(), 10);
}

TEST(CalibrationEstimator, KeepsARightCalibrationWithAMap) {
  SimulatedRun run(S::Vector::Zero(), true);
  run.AddKeyframes(14);
  EXPECT_EQ(run.num_changes(), 0);
}

TEST(CalibrationEstimator, RegistersDepth) {
  S::Vector truth = S::Vector::Zero();
  truth(S::kDepthFocalLength) = 0.1;
  truth(S::kDepthX) = 8.0 * kPixel;
  SimulatedRun run(truth, true);
  run.AddKeyframes(40);
  const CorrectionEstimate& estimate = run.estimator().estimate();
  EXPECT_EQ(estimate.is_corrected, (CorrectionGroups{false, false, false, true}));
  EXPECT_GE(run.num_changes(), 1);
  ASSERT_TRUE(run.estimator().present()->registration);
  EXPECT_NEAR(estimate.correction(S::kDepthFocalLength), 0.1, 0.01);
  EXPECT_NEAR(estimate.correction(S::kDepthX), truth(S::kDepthX), 3.0 * estimate.sigma(S::kDepthX));
}

TEST(CalibrationEstimator, CorrectsTheColourCameraAndTheRegistration) {
  S::Vector truth = S::Vector::Zero();
  truth(S::kFocalLength) = -0.04;
  truth(S::kDepthFocalLength) = 0.06;
  SimulatedRun run(truth, true);
  run.AddKeyframes(40);
  const CorrectionEstimate& estimate = run.estimator().estimate();
  EXPECT_EQ(estimate.is_corrected, (CorrectionGroups{true, false, false, true}));
  EXPECT_NEAR(estimate.correction(S::kFocalLength), -0.04, 0.01);
  EXPECT_NEAR(estimate.correction(S::kDepthFocalLength), 0.06, 0.01);
}

TEST(CalibrationEstimator, AcceptsTheDistortionOfALens) {
  S::Vector truth = S::Vector::Zero();
  truth(S::kK1) = -0.1;
  SimulatedRun run(truth);
  run.AddKeyframes(14);
  const CorrectionEstimate& estimate = run.estimator().estimate();
  EXPECT_TRUE(estimate.is_corrected[2]);
  EXPECT_NEAR(run.estimator().present()->distortion.k[0], -0.1, 0.01);
}

// Images that contradict the given lens, by more than any lens distorts.
TEST(CalibrationEstimator, UsesNoLensThatNoCameraHas) {
  S::Vector truth = S::Vector::Zero();
  truth(S::kK1) = 0.6;
  SimulatedRun run(truth);
  run.AddKeyframes(14);
  EXPECT_GT(run.estimator().estimate().log_odds[2], 0.0);
  EXPECT_EQ(run.num_changes(), 0);
  EXPECT_EQ(run.estimator().present(), run.camera().given());
  EXPECT_FALSE(run.estimator().estimate().IsCorrected());
}

TEST(CalibrationEstimator, KeepsWhatItKnowsWhenTheReadoutTimeChanges) {
  SimulatedRun run(S::Vector::Zero());
  run.AddKeyframes(10);
  const double sigma = run.estimator().estimate().sigma(S::kFocalLength);
  run.SetReadoutTime(0.02);
  run.Add(SimulatedCamera::PoseOf(10));
  EXPECT_LE(run.estimator().estimate().sigma(S::kFocalLength), sigma);
  EXPECT_FALSE(run.estimator().estimate().IsCorrected());
}

TEST(CalibrationEstimator, AcceptsNothingThatAPathDoesNotTell) {
  S::Vector truth = S::Vector::Zero();
  truth(S::kFocalLength) = -0.03;
  SimulatedRun run(truth);
  for (int i = 0; i < 6; ++i) EXPECT_FALSE(run.Add(Rigid3()));
  EXPECT_GT(run.estimator().estimate().sigma(S::kFocalLength),
            0.9 * WrongCalibrationSigma()(S::kFocalLength));
}

// A run that ends as soon as a correction is accepted, or after 40 keyframes.
struct Acceptance {
  int first_candidacy = -1;  // keyframe
  int keyframe = -1;
  double sigma = 0.0;   // of the logarithm of the focal length
  double sigmas = 0.0;  // of the correction that is accepted
};

Acceptance FindAcceptance(double focal_length, bool has_landmarks, double motion = 1.0) {
  S::Vector truth = S::Vector::Zero();
  truth(S::kFocalLength) = focal_length;
  SimulatedRun run(truth, has_landmarks);
  Acceptance acceptance;
  for (int i = 0; i < 40 && acceptance.keyframe < 0; ++i) {
    const Rigid3 pose = SimulatedCamera::PoseOf(i);
    const bool is_changed =
        run.Add({ExpSO3(motion * LogSO3(pose.rotation())), motion * pose.translation()});
    const CorrectionEstimate& estimate = run.estimator().estimate();
    acceptance.sigma = estimate.sigma(S::kFocalLength);
    if (acceptance.first_candidacy < 0 && estimate.log_odds[0] > std::log(kCandidateOdds)) {
      acceptance.first_candidacy = i;
    }
    if (!is_changed) continue;
    acceptance.keyframe = i;
    acceptance.sigmas = std::abs(estimate.correction(S::kFocalLength)) / acceptance.sigma;
  }
  return acceptance;
}

TEST(CalibrationEstimator, WaitsUntilACandidateHasLasted) {
  for (const bool has_landmarks : {false, true}) {
    const Acceptance acceptance = FindAcceptance(-0.06, has_landmarks);
    EXPECT_GE(acceptance.first_candidacy, 0);
    EXPECT_GE(acceptance.keyframe, acceptance.first_candidacy + 2);
  }
}

TEST(CalibrationEstimator, AcceptsNoCorrectionBelowThreeSigmas) {
  int num_accepted = 0;
  for (const double focal_length : {-0.05, -0.03, -0.015, 0.015}) {
    const Acceptance acceptance = FindAcceptance(focal_length, true);
    if (acceptance.keyframe < 0) continue;
    ++num_accepted;
    EXPECT_GT(acceptance.sigmas, 3.0) << focal_length;
  }
  EXPECT_GE(num_accepted, 2);
}

// The paths leave the focal length so uncertain that three standard deviations are not enough.
TEST(CalibrationEstimator, RequiresMoreSigmasOfWhatIsUncertain) {
  constexpr double kMotion = 0.3;
  constexpr double kCertain = 0.01;
  for (const double focal_length : {-0.12, -0.2}) {
    const Acceptance large = FindAcceptance(focal_length, false, kMotion);
    ASSERT_GE(large.keyframe, 0) << focal_length;
    EXPECT_GT(large.sigma, kCertain);
    EXPECT_GT(large.sigmas, 3.0 * large.sigma / kCertain);
  }
  constexpr double kSmall = 0.06;
  const Acceptance small = FindAcceptance(-kSmall, false, kMotion);
  EXPECT_GE(small.first_candidacy, 0);
  EXPECT_LT(small.keyframe, 0);
  EXPECT_GT(small.sigma, kCertain);
  EXPECT_GT(kSmall, 3.0 * small.sigma);
}

TEST(KeyframeIntrinsics, MovesFeaturesAndLandmarksTogether) {
  S::Vector truth = S::Vector::Zero();
  truth(S::kFocalLength) = 0.03;
  truth(S::kK1) = -0.1;
  SimulatedCamera camera(truth, 1);
  const auto [frame, depth] = camera.Record(Rigid3());
  Map map;
  const KeyframeId id = map.AddKeyframe(frame, Rigid3());
  const LandmarkId point = map.Add<PointLandmark>(id, 0, frame->PointInCamera(0));
  const auto corrected = std::make_shared<CameraIntrinsics>(Corrected(*camera.given(), truth));
  ChangeKeyframeIntrinsics(
      [&](KeyframeId, const std::shared_ptr<const Frame>& given) {
        return ChangeIntrinsics(given, corrected);
      },
      &map);
  const Frame& changed = *map.FindKeyframe(id)->frame;
  EXPECT_EQ(changed.intrinsics, corrected);
  const Eigen::Vector3d position = map.Find<PointLandmark>(point)->position;
  EXPECT_TRUE(position.isApprox(changed.PointInCamera(0), 1e-9));
  // The simulated camera has the corrected calibration: the point projects to its recorded pixel.
  const CorrectedCamera recorded(kGiven, LensDistortion());
  const Eigen::Vector2d pixel =
      recorded.Pixel<double>(Eigen::Vector2d(position.head<2>() / position.z()), truth.data());
  EXPECT_LT((pixel - frame->points[0].pixel).norm(), 1e-6);
}

}  // namespace
}  // namespace msc_vo
