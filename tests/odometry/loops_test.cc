// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// A walk along desks that look alike, back to the first one.

#include <algorithm>
#include <cmath>
#include <memory>

#include "tests/support/rendered_images.h"
#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include "msc_vo/checkpoint/binary_reader.h"
#include "msc_vo/checkpoint/binary_writer.h"
#include "msc_vo/geometry/so3.h"
#include "msc_vo/odometry/odometry.h"

namespace msc_vo {
namespace {

struct Walk {
  std::vector<FrameResult> live;
  OdometryResult result;
  size_t num_observed_loops = 0;  // at the last image
};

class LoopsTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    const SyntheticSequenceOptions options = QuickWalk(SceneKind::kDesks, 4, {1, true});
    sequence_ = std::make_unique<SyntheticSequence>(options);
    images_ = RenderImages(options, *sequence_->WalkLength());
  }
  static void TearDownTestSuite() {
    sequence_.reset();
    images_.clear();
  }

  // `saved_after`: number of the image after which the run is saved and continued in another
  // object; 0: never.
  Walk Track(OdometryOptions options, int saved_after = 0) {
    auto odometry = std::make_unique<Odometry>(options, sequence_->camera(), LensDistortion());
    Walk run;
    odometry->SetTrackingObserver(
        [&run](const TrackedImage& tracked) { run.num_observed_loops = tracked.loops.size(); });
    for (int i = 0; i < static_cast<int>(images_.size()); ++i) {
      run.live.push_back(odometry->Process(images_[i]));
      if (i != saved_after || i == 0) continue;
      ObjectJournal journal;
      BinaryWriter writer(&journal);
      EXPECT_TRUE(odometry->Save(&writer));
      odometry = std::make_unique<Odometry>(options, sequence_->camera(), LensDistortion());
      ObjectJournal loaded(journal.pending());
      BinaryReader reader(writer.bytes(), &loaded);
      odometry->Restore(&reader);
    }
    run.result = odometry->Finish();
    return run;
  }

  static inline std::unique_ptr<SyntheticSequence> sequence_;
  static inline std::vector<RgbdImage> images_;
};

Rigid3 Motion(const Rigid3& now, const Rigid3& before) { return now * before.Inverse(); }

TEST_F(LoopsTest, AreClosedAtTheTruePlaceAndNamed) {
  const Walk run = Track({});
  ASSERT_EQ(run.result.loops.size(), 1u);
  EXPECT_EQ(run.num_observed_loops, 1u);
  const Loop& loop = run.result.loops[0];
  EXPECT_GE(loop.num_keyframes, 3);
  EXPECT_GT(loop.frame, loop.reference + 50);
  // Both frames are at the same desk; the next one is more than two metres away.
  const Rigid3 truth = Motion(sequence_->PoseAt(loop.frame).world_from_cam.Inverse(),
                              sequence_->PoseAt(loop.reference).world_from_cam.Inverse());
  EXPECT_LT(truth.translation().norm(), 1.5);
  const Rigid3 estimate = Motion(run.result.frames[loop.frame].cam_from_world,
                                 run.result.frames[loop.reference].cam_from_world);
  EXPECT_LT((estimate.translation() - truth.translation()).norm(), 0.01);
  // The correction is named once, and moves the pose in the map, not the continuous one.
  int num_changes = 0;
  for (size_t i = 1; i < run.live.size(); ++i) {
    const FrameResult &now = run.live[i], &before = run.live[i - 1];
    const Eigen::Vector3d step =
        Motion(now.cam_from_odometry, before.cam_from_odometry).translation();
    EXPECT_LT(step.norm(), 0.15) << i;  // 55 mm on the mean
    if (!now.world_changed) continue;
    ++num_changes;
    EXPECT_GT(static_cast<int>(i), loop.frame);
    EXPECT_EQ(now.world_changed->old_world, 0);
    ASSERT_TRUE(now.world_changed->new_from_old);
    const Rigid3 moved = before.cam_from_world * now.world_changed->new_from_old->Inverse();
    const Rigid3 error = Motion(now.cam_from_world, moved) *
                         Motion(now.cam_from_odometry, before.cam_from_odometry).Inverse();
    EXPECT_LT(error.translation().norm(), 0.002);
  }
  EXPECT_EQ(num_changes, 1);
}

// Errors of a pose relative to the first frame, by a covariance, squared; 6 degrees of freedom.
double SquaredError(const Rigid3& estimate, const Rigid3& truth, const PoseCovariance& covariance) {
  const Rigid3 error = estimate * truth.Inverse();
  Eigen::Matrix<double, 6, 1> tangent;
  tangent << LogSO3(error.rotation()), error.translation();
  return tangent.dot(CameraCovariance(estimate, covariance).ldlt().solve(tangent));
}

TEST_F(LoopsTest, ReduceTheCovarianceOfPosesInTheWorld) {
  const Walk run = Track({});
  ASSERT_EQ(run.result.loops.size(), 1u);
  const Rigid3 first = sequence_->PoseAt(0).world_from_cam;
  double largest = 0.0;  // standard deviation in the world before the loop, metres
  for (size_t i = 1; i < run.live.size(); ++i) {
    const FrameResult &live = run.live[i], &final = run.result.frames[i];
    ASSERT_TRUE(live.covariance && live.world_covariance && live.odometry_covariance) << i;
    ASSERT_TRUE(final.world_covariance) << i;
    const auto sigma = [](const Rigid3& pose, const PoseCovariance& covariance) {
      return std::sqrt(CameraCovariance(pose, covariance).bottomRightCorner<3, 3>().trace());
    };
    const double in_world = sigma(live.cam_from_world, *live.world_covariance);
    EXPECT_GE(in_world, sigma(live.cam_from_world, *live.covariance)) << i;
    if (static_cast<int>(i) <= run.result.loops[0].frame) {
      largest = std::max(largest, in_world);
    } else if (i + 1 == run.live.size()) {
      EXPECT_LT(in_world, 0.3 * largest);
      EXPECT_LT(in_world, 0.4 * sigma(live.cam_from_odometry, *live.odometry_covariance));
    }
    // 99.9 % quantile of chi-square with 6 degrees of freedom: 22.5.
    const Rigid3 truth = sequence_->PoseAt(static_cast<int>(i)).world_from_cam.Inverse() * first;
    EXPECT_LT(SquaredError(live.cam_from_world, truth, *live.world_covariance), 22.5) << i;
    EXPECT_LT(SquaredError(final.cam_from_world, truth, *final.world_covariance), 22.5) << i;
    EXPECT_LT(SquaredError(live.cam_from_odometry, truth, *live.odometry_covariance), 22.5) << i;
  }
}

TEST_F(LoopsTest, AreNotClosedIfSwitchedOff) {
  OdometryOptions options;
  options.tracking.find_loops = false;
  const Walk run = Track(options);
  EXPECT_TRUE(run.result.loops.empty());
  for (const FrameResult& frame : run.live) EXPECT_FALSE(frame.world_changed);
}

TEST_F(LoopsTest, AreTheSameAtAnyNumberOfThreadsAndAfterARestore) {
  OdometryOptions options;
  const Walk two = Track(options);
  ASSERT_EQ(two.result.loops.size(), 1u);
  const int closed = two.result.loops[0].frame;
  options.threads = 1;
  for (const int saved_after : {0, closed - 3, closed + 1}) {
    const Walk other = Track(options, saved_after);
    ASSERT_EQ(other.result.loops.size(), 1u) << saved_after;
    EXPECT_EQ(other.result.loops[0].reference, two.result.loops[0].reference);
    for (size_t i = 0; i < two.result.frames.size(); ++i) {
      ASSERT_EQ(other.result.frames[i].cam_from_world.params,
                two.result.frames[i].cam_from_world.params)
          << i << " saved after " << saved_after;
      ASSERT_EQ(other.live[i].world_changed.has_value(), two.live[i].world_changed.has_value());
      ASSERT_EQ(other.live[i].world_covariance, two.live[i].world_covariance) << i;
      ASSERT_EQ(other.live[i].odometry_covariance, two.live[i].odometry_covariance) << i;
    }
  }
}

}  // namespace
}  // namespace msc_vo
