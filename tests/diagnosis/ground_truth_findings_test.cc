// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <functional>
#include <string>
#include <vector>

#include "tests/diagnosis/expected_finding.h"
#include "tests/diagnosis/recording.h"
#include "tests/support/temporary_folder.h"
#include <gtest/gtest.h>

#include "msc_vo/datasets/sequence_calibration.h"
#include "msc_vo/diagnosis/depth_quality.h"
#include "msc_vo/diagnosis/motion_track.h"
#include "msc_vo/diagnosis/sequence_findings.h"
#include "msc_vo/geometry/timed_pose.h"

namespace msc_vo {
namespace {

constexpr int kNumTrackedImages = 60;

// Wrong ground truth of one recording, whose images are tracked once.
class GroundTruthTest : public TemporaryFolder {
 protected:
  void Track(const SyntheticSequenceOptions& options,
             const std::function<void(Recording*)>& change = {}) {
    Recording recording = Record(options, kNumTrackedImages);
    if (change) change(&recording);
    recording.Write(Folder());
    SequenceIndex index = OpenSequence(Folder());
    const Calibration calibration = ResolveCalibration(CameraSettings(), "", &index);
    truth_ = index.ground_truth;
    track_ = TrackMotion(RgbdDecoder(index, calibration), OdometryOptions(), kNumTrackedImages);
  }

  Findings Diagnose(const std::vector<TimedPose>& truth, const DepthUnits& units = {5000.0, false},
                    bool is_calibrated = true) const {
    Findings findings;
    AddGroundTruthMotionFindings(track_, truth, units, is_calibrated, &findings);
    return findings;
  }

  Finding ExpectWarning(const std::string& check, const NamesMatcher& names,
                        const std::function<void(TimedPose*)>& change,
                        const DepthUnits& units = {5000.0, false}) const {
    std::vector<TimedPose> truth = truth_;
    for (TimedPose& pose : truth) change(&pose);
    return ExpectFinding(Diagnose(truth, units), Severity::kWarning, check, names, check);
  }

  // Poses of a body whose origin and axes in the camera frame are given.
  static Rigid3 WithBody(const Rigid3& world_from_cam, const Rigid3& camera_from_body) {
    return world_from_cam * camera_from_body;
  }

  MotionTrack track_;
  std::vector<TimedPose> truth_;
};

TEST_F(GroundTruthTest, FindsWrongPoses) {
  Track(SmallRoom());
  for (const Finding& finding : Diagnose(truth_)) {
    EXPECT_EQ(finding.severity, Severity::kGood) << finding.check << ": " << Describe(finding);
  }
  ExpectWarning("ground_truth.convention", Names("inverse"),
                [](TimedPose* p) { p->world_from_cam = p->world_from_cam.Inverse(); });
  ExpectWarning("ground_truth.convention", Names("w x y z"), [](TimedPose* p) {
    const Eigen::Quaterniond q(p->world_from_cam.rotation());
    p->world_from_cam.params.head<4>() << q.w(), q.x(), q.y(), q.z();
  });
  ExpectWarning("ground_truth.convention", Names("z, -x, -y"), [](TimedPose* p) {
    const Eigen::Matrix3d axes = (Eigen::Matrix3d() << 0, -1, 0, 0, 0, -1, 1, 0, 0).finished();
    p->world_from_cam =
        WithBody(p->world_from_cam, {Eigen::Quaterniond(axes), Eigen::Vector3d::Zero()});
  });
  ExpectWarning("ground_truth.positions", Names("axes"), [](TimedPose* p) {
    const Eigen::Vector3d t = p->world_from_cam.translation();
    p->world_from_cam.translation() = Eigen::Vector3d(t.x(), t.z(), t.y());
  });
  // Times and scales.
  ExpectWarning("ground_truth.time_offset", Names("later", "subtract"),
                [](TimedPose* p) { p->timestamp += 0.15; });
  ExpectWarning("ground_truth.time_offset", Names("earlier", "add"),
                [](TimedPose* p) { p->timestamp -= 0.15; });
  // Depth that is 3 % too long has the same effect as a world that is 3 % too small.
  const Finding small =
      ExpectWarning("ground_truth.scale", Names("depth_scale", "5000.0"),
                    [](TimedPose* p) { p->world_from_cam.translation() /= 1.03; });
  EXPECT_NEAR(small.value.value_or(0.0), 1.03, 0.01);
  ExpectWarning("ground_truth.scale", Names("depth_scale", "5000"),
                [](TimedPose* p) { p->world_from_cam.translation() *= 5.0; }, {25000.0, false});
  ExpectWarning("ground_truth.scale", Names("depth_scale", "5000"),
                [](TimedPose* p) { p->world_from_cam.translation() /= 5.0; }, {1000.0, false});
  ExpectWarning("ground_truth.scale", Names("camera.float_depth_scale", "1 units"),
                [](TimedPose* p) { p->world_from_cam.translation() *= 10.0; }, {10.0, true});
  // With another error of the calibration.
  std::vector<TimedPose> scaled = truth_;
  for (TimedPose& pose : scaled) pose.world_from_cam.translation() /= 1.1;
  const Findings uncalibrated = Diagnose(scaled, {5000.0, false}, false);
  ExpectFinding(uncalibrated, Severity::kGood, "ground_truth.scale", Names("not tested"),
                "uncalibrated");
  EXPECT_EQ(Text(uncalibrated).find("depth_scale"), std::string::npos) << Text(uncalibrated);
  // Another sequence.
  SyntheticSequenceOptions other_options = SmallRoom();
  other_options.scene = SceneKind::kSlanted;
  other_options.seed = 7;
  const SyntheticSequence other(other_options);
  std::vector<TimedPose> truth;
  for (int i = 0; i < kNumTrackedImages; ++i) truth.push_back(other.PoseAt(i));
  ExpectFinding(Diagnose(truth), Severity::kWarning, "ground_truth.convention", Names("motion"),
                "other sequence");
}

TEST_F(GroundTruthTest, FindsAnotherBody) {
  SyntheticSequenceOptions options = SmallRoom();
  options.path.shake = 3.0;
  Track(options);
  ExpectWarning("ground_truth.hand_eye", Names("hand-eye"), [](TimedPose* p) {
    p->world_from_cam = WithBody(p->world_from_cam,
                                 {Eigen::Quaterniond::Identity(), Eigen::Vector3d(0.0, -0.3, 0.0)});
  });
}

// A blank room, whose walls leave some motions free.
TEST_F(GroundTruthTest, IsNotBlamedForWeakPoses) {
  SyntheticSequenceOptions options = SmallRoom();
  options.scene = SceneKind::kBlank;
  options.seed = 2;
  Track(options);
  EXPECT_GT(track_.num_weak, 5);
  EXPECT_LE(static_cast<int>(track_.images.size()) + track_.num_weak, kNumTrackedImages);
  for (const Finding& finding : Diagnose(truth_)) {
    EXPECT_EQ(finding.severity, Severity::kGood) << finding.check << ": " << Describe(finding);
  }
}

}  // namespace
}  // namespace msc_vo
