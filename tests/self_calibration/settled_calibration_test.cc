// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Self-calibration with enough images: it goes on without them.

#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "tests/support/simulated_camera.h"
#include <gtest/gtest.h>

#include "msc_vo/checkpoint/binary_reader.h"
#include "msc_vo/checkpoint/binary_writer.h"
#include "msc_vo/frame/frame_intrinsics.h"
#include "msc_vo/self_calibration/calibration_estimator.h"
#include "msc_vo/self_calibration/keyframe_frames.h"

namespace msc_vo {
namespace {

using S = SensorCorrection;

// The number of pairs that the estimate requires if the given calibration may be wrong.
constexpr int kSettledPairs = 150;

// An image, its features and its pose.
struct Recording {
  std::shared_ptr<const Frame> frame;
  std::shared_ptr<const RecordedImage> image;
  Rigid3 cam_from_world;
};

// A trajectory of a few images, which a run repeats.
std::vector<Recording> Record(const S::Vector& truth, const std::vector<Rigid3>& poses) {
  SimulatedCamera camera(truth, 1);
  std::vector<Recording> recordings;
  for (const Rigid3& pose : poses) {
    const auto [frame, depth] = camera.Record(pose);
    const cv::Mat gray(depth.size(), CV_8UC1, cv::Scalar(128));  // without edges
    recordings.push_back(
        {frame, std::make_shared<RecordedImage>(gray, depth, DepthSensor::kStructuredLight), pose});
  }
  return recordings;
}

std::vector<Rigid3> HandHeldPoses(int count = 12) {
  std::vector<Rigid3> poses;
  for (int i = 0; i < count; ++i) poses.push_back(SimulatedCamera::PoseOf(i));
  return poses;
}

// A camera that turns about its axis, which does not tell the focal length.
std::vector<Rigid3> RollingPoses() {
  std::vector<Rigid3> poses;
  for (const double angle : {0.0, 0.3, -0.3, 0.15}) {
    poses.emplace_back(ExpSO3({0.0, 0.0, angle}), Eigen::Vector3d::Zero());
  }
  return poses;
}

class SettledRun {
 public:
  explicit SettledRun(std::vector<Recording> recordings)
      : recordings_(std::move(recordings)), estimator_(recordings_[0].frame->intrinsics) {}

  // Adds a keyframe after `num_images` other images. Returns whether the calibration has changed.
  bool Add(int num_images) {
    std::vector<CalibrationImage> images;
    for (int i = 0; i < num_images; ++i) {
      const Recording& recording = Next();
      images.push_back({recording.frame, recording.image, newest_,
                        recording.cam_from_world * map_.CamFromWorld(newest_).Inverse()});
    }
    const Recording& recording = Next();
    AddToMap(recording);
    return Update(recording.image, images);
  }
  // Adds a keyframe to the map; then, without images, to the estimate.
  void AddToMap() { AddToMap(Next()); }
  bool UpdateWithoutImages() { return Update(nullptr, {}); }
  bool AddWithoutImages() {
    AddToMap();
    return UpdateWithoutImages();
  }
  // Adds keyframes with images between them, until the estimate has settled.
  void Settle() {
    Add(0);
    for (int i = 0; i < 40 && !estimator_.IsSettled(); ++i) Add(7);
    ASSERT_TRUE(estimator_.IsSettled());
  }
  // Continues with other images.
  void Continue(std::vector<Recording> recordings) {
    recordings_ = std::move(recordings);
    next_ = 0;
    Recalibrate();
  }
  void BeginMap() {
    map_ = map_.Next();
    landmarks_.clear();
    keyframes_.clear();
  }

  const CalibrationEstimator& estimator() const { return estimator_; }
  // References of this object to images.
  long num_held_images() const { return static_cast<long>(recordings_.size() + keyframes_.size()); }
  const Map& map() const { return map_; }
  KeyframeId newest() const { return newest_; }

 private:
  const Recording& Next() { return recordings_[next_++ % recordings_.size()]; }
  void AddToMap(const Recording& recording) {
    newest_ = map_.AddKeyframe(recording.frame, recording.cam_from_world);
    keyframes_[newest_] = recording;
    Observe(newest_, &landmarks_, &map_);
  }
  bool Update(const std::shared_ptr<const RecordedImage>& image,
              const std::vector<CalibrationImage>& images) {
    if (!estimator_.Update(map_, newest_, image, images, 0.0)) return false;
    Recalibrate();
    for (auto& [id, recording] : keyframes_) Recalibrate(&recording);
    ChangeKeyframeIntrinsics(
        [this](KeyframeId id, const auto& /*frame*/) { return keyframes_[id].frame; }, &map_);
    return true;
  }
  // Brings frames up to date with the calibration in use.
  void Recalibrate() {
    for (Recording& recording : recordings_) Recalibrate(&recording);
  }
  void Recalibrate(Recording* recording) const {
    const auto present = estimator_.present();
    recording->frame =
        HasSameRegistration(*recording->frame->intrinsics, *present)
            ? ChangeIntrinsics(recording->frame, present)
            : MeasureSimulatedDepth(*recording->frame, recording->image->Depth(), present);
  }

  std::vector<Recording> recordings_;
  size_t next_ = 0;
  CalibrationEstimator estimator_;
  Map map_;
  LandmarksByDescriptor landmarks_;
  std::map<KeyframeId, Recording> keyframes_;
  KeyframeId newest_ = kNoId;
};

// All images but the first one form a pair.
TEST(SettledCalibration, NeedsEnoughPairsOfAWrongCalibration) {
  S::Vector truth = S::Vector::Zero();
  truth(S::kFocalLength) = -0.05;
  SettledRun run(Record(truth, HandHeldPoses()));
  for (int i = 0; i < 5; ++i) run.Add(0);
  run.Add(kSettledPairs - 6);
  EXPECT_FALSE(run.estimator().IsSettled());
  run.Add(0);
  EXPECT_TRUE(run.estimator().IsSettled());
}

TEST(SettledCalibration, EndsEarlierIfTheGivenCalibrationIsCertainlyRight) {
  SettledRun run(Record(S::Vector::Zero(), HandHeldPoses()));
  run.Add(0);
  int num_pairs = 0;
  for (; num_pairs < kSettledPairs && !run.estimator().IsSettled(); num_pairs += 2) run.Add(1);
  EXPECT_GT(num_pairs, 10);
  EXPECT_LT(num_pairs, kSettledPairs / 2);
  const CorrectionEstimate& estimate = run.estimator().estimate();
  for (const double log_odds : estimate.log_odds) EXPECT_LT(log_odds, -std::log(kAcceptedOdds));
  EXPECT_FALSE(estimate.IsCorrected());
}

TEST(SettledCalibration, NeedsACertainColourCamera) {
  SettledRun run(Record(S::Vector::Zero(), RollingPoses()));
  for (int i = 0; i < 5; ++i) run.Add(0);
  run.Add(kSettledPairs);
  EXPECT_FALSE(run.estimator().IsSettled());
  EXPECT_GT(run.estimator().estimate().sigma(S::kFocalLength),
            0.9 * WrongCalibrationSigma()(S::kFocalLength));
  run.Continue(Record(S::Vector::Zero(), HandHeldPoses()));
  run.Add(60);
  EXPECT_TRUE(run.estimator().IsSettled());
}

TEST(SettledCalibration, NeedsAndKeepsNoImages) {
  SettledRun run(Record(S::Vector::Zero(), HandHeldPoses()));
  run.Settle();
  const KeyframeId last = run.newest();
  const auto present = run.estimator().present();
  const double sigma = run.estimator().estimate().sigma(S::kFocalLength);
  for (int i = 0; i < 3; ++i) EXPECT_FALSE(run.AddWithoutImages());
  EXPECT_TRUE(run.estimator().IsSettled());
  EXPECT_EQ(run.estimator().present(), present);
  EXPECT_EQ(run.estimator().estimate().sigma(S::kFocalLength), sigma);
  EXPECT_EQ(run.estimator().FindImage(last), nullptr);
}

// The images are held by the test alone.
TEST(SettledCalibration, FreesTheImagesOfPairs) {
  const std::vector<Recording> recordings = Record(S::Vector::Zero(), HandHeldPoses());
  SettledRun run(recordings);
  const auto count = [&] {
    long sum = 0;
    for (const Recording& recording : recordings) sum += recording.image.use_count();
    return sum;
  };
  run.Add(0);
  run.Add(7);
  const long before = count() - run.num_held_images();
  EXPECT_GT(before, static_cast<long>(recordings.size()));
  run.Settle();
  EXPECT_EQ(count() - run.num_held_images(), static_cast<long>(recordings.size()));
}

// Further pairs tell as much as those that they replace in memory.
TEST(SettledCalibration, EndsAlsoIfThePathDoesNotTellTheCamera) {
  SettledRun run(Record(S::Vector::Zero(), RollingPoses()));
  for (int i = 0; i < 5; ++i) run.Add(0);
  for (int i = 0; i < 20 && !run.estimator().IsSettled(); ++i) run.Add(kSettledPairs / 6);
  EXPECT_TRUE(run.estimator().IsSettled());
  EXPECT_FALSE(run.estimator().estimate().IsCorrected());
}

S::Vector Truth(double focal_length, double depth_focal_length) {
  S::Vector truth = S::Vector::Zero();
  truth(S::kFocalLength) = focal_length;
  truth(S::kDepthFocalLength) = depth_focal_length;
  return truth;
}

// Replaces the information of the map in the state of an estimator: depth is certainly registered.
struct MapOfRegisteredDepth {
  template <typename... Members>
  void operator()(Members&... members) const {
    (Set(&members), ...);
  }
  template <typename Member>
  static void Set(Member* /*member*/) {}
  static void Set(std::optional<CalibrationInformation>* of_map) {
    of_map->emplace();
    for (const int i : IndicesOf(CorrectionGroup::kDepthRegistration)) {
      (*of_map)->matrix(i, i) = 1e8;
    }
  }
};

// Without images, depths cannot be measured again.
TEST(SettledCalibration, KeepsARegistrationThatTheMapContradicts) {
  SettledRun run(Record(Truth(0.0, 0.06), HandHeldPoses()));
  run.Settle();
  CalibrationEstimator estimator = run.estimator();
  const auto present = estimator.present();
  ASSERT_TRUE(present->registration);
  const MapOfRegisteredDepth contradiction;
  estimator.Serialize(contradiction);
  run.AddToMap();
  EXPECT_FALSE(estimator.Update(run.map(), run.newest(), nullptr, {}, 0.0));
  EXPECT_LT(estimator.estimate().log_odds[3], -std::log(kAcceptedOdds));
  EXPECT_EQ(estimator.estimate().is_corrected, (CorrectionGroups{false, false, false, true}));
  EXPECT_EQ(estimator.present(), present);
}

// A camera whose depth images are not registered, and whose lens gets warm once the estimate has
// settled.
class WarmLens : public testing::Test {
 protected:
  void SetUp() override {
    run_.Settle();
    ASSERT_EQ(run_.estimator().estimate().is_corrected,
              (CorrectionGroups{true, false, false, true}));
  }
  void WarmUp() {
    run_.BeginMap();
    run_.Continue(Record(Truth(-0.02, 0.06), HandHeldPoses(kNumKeyframes)));
  }

  static constexpr int kNumKeyframes = 6;
  SettledRun run_{Record(Truth(-0.04, 0.06), HandHeldPoses())};
};

TEST_F(WarmLens, IsCorrectedByTheMapWhileTheRegistrationRemains) {
  const auto settled = run_.estimator().present();
  WarmUp();
  int num_changes = 0;
  for (int i = 0; i < kNumKeyframes; ++i) num_changes += run_.AddWithoutImages() ? 1 : 0;
  EXPECT_GE(num_changes, 1);
  const auto present = run_.estimator().present();
  EXPECT_GT(present->camera.fx, settled->camera.fx + 1.0);
  EXPECT_LT(present->camera.fx, std::exp(-0.02) * kGiven.fx);
  ASSERT_TRUE(present->registration && settled->registration);
  EXPECT_TRUE(HasSameRegistration(*present, *settled));
  EXPECT_EQ(run_.estimator().estimate().is_corrected, (CorrectionGroups{true, false, false, true}));
}

// Images that contradict a correction outweigh those that made it.
TEST(TakenBackCorrection, IsNotAcceptedAgain) {
  SettledRun run(Record(Truth(-0.05, 0.0), HandHeldPoses()));
  run.Add(0);
  for (int i = 0; i < 10 && !run.estimator().estimate().is_corrected[0]; ++i) run.Add(1);
  ASSERT_TRUE(run.estimator().estimate().is_corrected[0]);
  run.BeginMap();
  run.Continue(Record(S::Vector::Zero(), HandHeldPoses()));
  run.Add(0);
  int num_changes = 0;
  for (int i = 0; i < 14; ++i) num_changes += run.Add(8) ? 1 : 0;
  EXPECT_FALSE(run.estimator().estimate().IsCorrected());
  EXPECT_EQ(run.estimator().present()->camera.fx, kGiven.fx);
  EXPECT_LE(num_changes, 4);
}

TEST_F(WarmLens, IsCorrectedInTheSameWayAfterACheckpoint) {
  ObjectJournal journal;
  BinaryWriter writer(&journal);
  writer(run_.estimator());
  ObjectJournal loaded(journal.pending());
  BinaryReader reader(writer.bytes(), &loaded);
  CalibrationEstimator restored(std::make_shared<CameraIntrinsics>(CameraIntrinsics{kGiven, {}}));
  reader(restored);
  reader.Finish();
  ASSERT_TRUE(restored.IsSettled());

  int num_changes = 0;
  for (int i = -1; i < kNumKeyframes; ++i) {
    if (i == 0) WarmUp();
    run_.AddToMap();
    const bool has_changed = restored.Update(run_.map(), run_.newest(), nullptr, {}, 0.0);
    EXPECT_EQ(run_.UpdateWithoutImages(), has_changed);
    num_changes += has_changed ? 1 : 0;
    const CalibrationEstimator& expected = run_.estimator();
    EXPECT_EQ(restored.estimate().correction, expected.estimate().correction);
    EXPECT_EQ(restored.estimate().sigma, expected.estimate().sigma);
    EXPECT_EQ(restored.present()->camera.fx, expected.present()->camera.fx);
    EXPECT_TRUE(HasSameRegistration(*restored.present(), *expected.present()));
  }
  EXPECT_GE(num_changes, 1);
}

}  // namespace
}  // namespace msc_vo
