// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/odometry/pose_refiner.h"

#include <memory>
#include <vector>

#include "tests/support/plane_features.h"
#include <gtest/gtest.h>

#include "msc_vo/geometry/so3.h"
#include "msc_vo/tracking/tracked_frame.h"

namespace msc_vo {
namespace {

constexpr PinholeCamera kCamera{500.0, 500.0, 320.0, 240.0, 640, 480};
constexpr double kDelay = 5.0;

// A keyframe at the origin of the world, its landmarks, and a frame that has been tracked in a map
// with a wrong pose.
class PoseRefinerTest : public testing::Test {
 protected:
  PoseRefinerTest() {
    for (int i = 0; i < 36; ++i) {
      const double depth = 2.0 + 0.05 * i;
      positions_.emplace_back(0.3 * (i % 6 - 2.5), 0.2 * (i / 6 - 2.5), depth);
    }
    keyframe_ = snapshot_.map.AddKeyframe(Observe(0.0, Rigid3()), Rigid3());
    for (size_t i = 0; i < positions_.size(); ++i) {
      points_.push_back(
          snapshot_.map.Add<PointLandmark>(keyframe_, static_cast<int>(i), positions_[i]));
    }
    poses_.push_back({keyframe_, wrong_});
  }

  std::shared_ptr<const Frame> Observe(double timestamp, const Rigid3& cam_from_world) const {
    auto frame = std::make_shared<Frame>();
    frame->timestamp = timestamp;
    frame->camera = kCamera;
    for (const Eigen::Vector3d& position : positions_) {
      const Eigen::Vector3d x = cam_from_world * position;
      PointFeature point;
      point.pixel = kCamera.Project(x);
      point.inverse_depth = 1.0 / x.z();
      point.inverse_depth_sigma = 0.002;
      frame->points.push_back(point);
    }
    return frame;
  }

  TrackedFrame Tracked(double timestamp) const {
    TrackedFrame tracked;
    tracked.frame = Observe(timestamp, truth_);
    tracked.status = TrackingStatus::kTracked;
    tracked.reference = keyframe_;
    tracked.cam_from_reference = wrong_;
    for (size_t i = 0; i < points_.size(); ++i) {
      tracked.matches.points.push_back({static_cast<int>(i), points_[i], positions_[i]});
    }
    return tracked;
  }

  bool IsRefined() const {
    return (poses_[0].cam_from_reference.params - truth_.params).norm() < 1e-6;
  }
  bool IsUnchanged() const { return poses_[0].cam_from_reference.params == wrong_.params; }

  const Rigid3 truth_{ExpSO3(Eigen::Vector3d(0.02, -0.05, 0.01)), Eigen::Vector3d(0.1, 0.0, -0.05)};
  const Rigid3 wrong_{ExpSO3(Eigen::Vector3d(0.022, -0.05, 0.01)),
                      Eigen::Vector3d(0.1, 0.01, -0.05)};
  PoseRefiner refiner_{PoseOptions(), kDelay};
  MapSnapshot snapshot_;
  std::vector<Eigen::Vector3d> positions_;  // of the landmarks, as the frame observes them
  KeyframeId keyframe_ = kNoId;
  std::vector<LandmarkId> points_;
  std::vector<ReferencedPose> poses_;
};

TEST_F(PoseRefinerTest, EstimatesThePoseInThePresentMap) {
  refiner_.Add(0, Tracked(1.0), snapshot_);
  refiner_.Refine(7.0, snapshot_, &poses_);
  EXPECT_TRUE(IsRefined());
}

TEST_F(PoseRefinerTest, WaitsForTheDelay) {
  refiner_.Add(0, Tracked(1.0), snapshot_);
  refiner_.Refine(5.5, snapshot_, &poses_);
  EXPECT_TRUE(IsUnchanged());
  refiner_.Refine(6.5, snapshot_, &poses_);
  EXPECT_TRUE(IsRefined());
}

TEST_F(PoseRefinerTest, EstimatesEachPoseOnce) {
  refiner_.Add(0, Tracked(1.0), snapshot_);
  refiner_.Refine(7.0, snapshot_, &poses_);
  poses_[0].cam_from_reference = wrong_;
  refiner_.Refine(20.0, snapshot_, &poses_);
  EXPECT_TRUE(IsUnchanged());
}

TEST_F(PoseRefinerTest, EstimatesAllPosesOnRequest) {
  refiner_.Add(0, Tracked(1.0), snapshot_);
  for (int i = 0; i < 2; ++i) {  // the frames are kept
    poses_[0].cam_from_reference = wrong_;
    refiner_.RefineAll(snapshot_, &poses_);
    EXPECT_TRUE(IsRefined());
  }
}

TEST_F(PoseRefinerTest, LeavesKeyframesToBundleAdjustment) {
  TrackedFrame tracked = Tracked(1.0);
  tracked.keyframe.id = 1;
  refiner_.Add(0, tracked, snapshot_);
  refiner_.RefineAll(snapshot_, &poses_);
  EXPECT_TRUE(IsUnchanged());
}

TEST_F(PoseRefinerTest, LeavesFramesWhoseSegmentWasDiscarded) {
  refiner_.Add(0, Tracked(1.0), snapshot_);
  poses_[0].reference = kNoId;
  refiner_.RefineAll(snapshot_, &poses_);
  EXPECT_TRUE(IsUnchanged());
}

// A wall that is 2 cm off in the map, with a sigma of half a millimetre.
TEST_F(PoseRefinerTest, UsesPlanesOfTheSameNumberingAlone) {
  TrackedFrame tracked = Tracked(1.0);
  auto frame = std::make_shared<Frame>(*tracked.frame);
  frame->planes = {FeatureOf(truth_ * Plane({0.0, 0.0, -1.0}, 4.0))};
  frame->planes[0].covariance = 1e-9 * Eigen::Matrix3d::Identity();
  tracked.frame = frame;
  tracked.planes = {{0, 5}};
  snapshot_.planes.planes.push_back({5, Plane({0.0, 0.0, -1.0}, 4.02)});
  refiner_.Add(0, tracked, snapshot_);
  refiner_.RefineAll(snapshot_, &poses_);
  EXPECT_FALSE(IsRefined());
  snapshot_.planes.numbering = 1;
  refiner_.RefineAll(snapshot_, &poses_);
  EXPECT_TRUE(IsRefined());
  snapshot_.planes.numbering = 0;
  snapshot_.calibration_is_doubted = true;
  poses_[0].cam_from_reference = wrong_;
  refiner_.RefineAll(snapshot_, &poses_);
  EXPECT_TRUE(IsRefined());
}

TEST_F(PoseRefinerTest, KeepsAPoseIfMostLandmarksAreGone) {
  refiner_.Add(0, Tracked(1.0), snapshot_);
  for (size_t i = 0; i < 19; ++i) snapshot_.map.Remove<PointLandmark>(points_[i]);
  refiner_.RefineAll(snapshot_, &poses_);
  EXPECT_TRUE(IsUnchanged());
}

TEST_F(PoseRefinerTest, KeepsAPoseIfTheMapContradictsTheObservations) {
  refiner_.Add(0, Tracked(1.0), snapshot_);
  for (size_t i = 0; i < points_.size(); ++i) {
    const double sign = i % 2 == 0 ? 1.0 : -1.0;
    snapshot_.map.SetGeometry<PointLandmark>(points_[i],
                                             positions_[i] + Eigen::Vector3d(0.0, sign * 0.3, 0.0));
  }
  refiner_.RefineAll(snapshot_, &poses_);
  EXPECT_TRUE(IsUnchanged());
}

TEST_F(PoseRefinerTest, FollowsAnotherCalibration) {
  TrackedFrame tracked = Tracked(1.0);
  auto frame = std::make_shared<Frame>(*tracked.frame);
  auto given = std::make_shared<CameraIntrinsics>();
  given->camera = kCamera;
  given->camera.cx += 10.0;
  frame->camera = given->camera;
  frame->intrinsics = given;
  tracked.frame = frame;
  auto present = std::make_shared<CameraIntrinsics>();
  present->camera = kCamera;
  snapshot_.intrinsics = present;
  refiner_.Add(0, tracked, snapshot_);
  refiner_.RefineAll(snapshot_, &poses_);
  EXPECT_TRUE(IsRefined());
}

TEST_F(PoseRefinerTest, CanBeSwitchedOff) {
  refiner_ = PoseRefiner(PoseOptions(), 0.0);
  refiner_.Add(0, Tracked(1.0), snapshot_);
  refiner_.RefineAll(snapshot_, &poses_);
  EXPECT_TRUE(IsUnchanged());
}

}  // namespace
}  // namespace msc_vo
