// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/tracking/plane_pose.h"

#include <cmath>

#include "tests/support/plane_features.h"
#include "tests/support/synthetic_frames.h"
#include "tests/support/synthetic_map.h"
#include <gtest/gtest.h>

#include "msc_vo/geometry/so3.h"
#include "msc_vo/tracking/motion_model.h"

namespace msc_vo {
namespace {

// A corridor along z, whose walls and floor are not quite parallel to it in the map.
constexpr double kTilt = 5e-5;  // radians
const std::vector<Plane> kCorridor{Plane({1.0, 0.0, kTilt}, 1.0), Plane({-1.0, 0.0, kTilt}, 1.0),
                                   Plane({0.0, -1.0, kTilt}, 1.2)};

class CorridorTest : public ::testing::Test {
 protected:
  CorridorTest() {
    for (size_t i = 0; i < kCorridor.size(); ++i) {
      snapshot_.planes.planes.push_back({static_cast<LandmarkId>(i), kCorridor[i]});
      // The camera sees the walls a millimetre nearer.
      const Plane seen(kCorridor[i].normal(), kCorridor[i].offset() - 1e-3);
      frame_.planes.push_back(FeatureOf(seen));
    }
  }

  // Of the camera along the corridor, metres.
  static double Along(const Rigid3& cam_from_world) {
    return std::abs(cam_from_world.OriginInSource().z());
  }

  TrackerOptions options_;
  MapSnapshot snapshot_;
  Frame frame_;
};

TEST_F(CorridorTest, HoldsTheCameraWherePlanesLeaveItFree) {
  constexpr double kSeconds = 4.0;
  const ExpectedPose expected =
      ExpectPose({}, IsotropicCovariance(0.001, 0.01), 0.03, {}, kSeconds);
  const auto pose = EstimateByPlanes(options_, frame_, snapshot_, expected, {});
  ASSERT_TRUE(pose);
  ASSERT_EQ(pose->planes.size(), 3u);
  EXPECT_FALSE(pose->is_determined);
  EXPECT_LT(Along(pose->cam_from_world), 1e-3);
  const PoseCovariance covariance =
      CameraCovariance(pose->cam_from_world, pose->summary.covariance);
  const double rest_sigma = std::sqrt(CovarianceOfRest(kSeconds)(5, 5));
  EXPECT_NEAR(std::sqrt(covariance(5, 5)), rest_sigma, 0.01 * rest_sigma);
  EXPECT_LT(std::sqrt(covariance(3, 3)), 0.1);
  EXPECT_LT(std::sqrt(covariance(4, 4)), 0.1);
}

// Features of the last frame measure the motion of the camera, not its position.
TEST_F(CorridorTest, CorrectsTheErrorOfTheLastPoseAcrossTheCorridor) {
  std::vector<PlaneMatch> matches;
  for (int i = 0; i < 3; ++i) matches.push_back({i, i});
  PlanePosePrior prior{Rigid3(Eigen::Quaterniond::Identity(), {0.5, 0.0, 0.0})};
  prior.covariance = IsotropicCovariance(0.001, 0.002);
  prior.correctable = IsotropicCovariance(0.01, 1.0);
  FramePose pose;
  ASSERT_TRUE(CorrectByPlanes(options_, frame_, matches, snapshot_, prior, &pose));
  const Rigid3& cam_from_world = pose.cam_from_world;
  EXPECT_LT(std::abs(cam_from_world.OriginInSource().x()), 0.02);
  EXPECT_LT(Along(cam_from_world), 1e-3);
  const PoseCovariance covariance = CameraCovariance(cam_from_world, pose.summary.covariance);
  EXPECT_LT(std::sqrt(covariance(3, 3)), 0.1);
  EXPECT_NEAR(std::sqrt(covariance(5, 5)), 1.0, 0.01);
}

// A camera that moves along the corridor, in a map of points in given depths.
class PointsInCorridorTest : public CorridorTest {
 protected:
  static constexpr double kStep = 0.02;  // metres

  bool Hold(int num_points, double min_depth, double max_depth) {
    SyntheticFrames::Options options;
    options.num_points = num_points;
    options.num_lines = 0;
    options.min_depth = min_depth;
    options.max_depth = max_depth;
    options.pixel_noise = options.inverse_depth_noise = 0.0;
    SyntheticFrames world(options);
    const MapPlanes planes = snapshot_.planes;
    snapshot_ = MapOfOneKeyframe(world.MakeFrame(0, Rigid3()), Rigid3());
    snapshot_.planes = planes;
    Frame frame = *world.MakeFrame(1, Rigid3(Eigen::Quaterniond::Identity(), {0.0, 0.0, -kStep}));
    frame.planes = frame_.planes;
    const ExpectedPose expected = ExpectPose({}, IsotropicCovariance(0.001, 0.01), 0.03, {}, 0.1);
    pose_ = *EstimateByPlanes(options_, frame, snapshot_, expected, {});
    const LocalMap local = SelectVisibleLandmarks(snapshot_.map, frame, pose_.cam_from_world);
    return HoldByLandmarks(options_, frame, snapshot_, local, expected, {}, &pose_);
  }

  PlanePose pose_;
};

TEST_F(PointsInCorridorTest, PointsHoldWhatPlanesLeaveFree) {
  ASSERT_TRUE(Hold(40, 2.0, 6.0));
  EXPECT_TRUE(pose_.is_determined);
  EXPECT_GT(pose_.landmarks.points.size(), 20u);
  EXPECT_NEAR(Along(pose_.cam_from_world), kStep, 0.1 * kStep);
}

// The prior alone has a sigma of 5 cm.
TEST_F(PointsInCorridorTest, PointsTooFarAwayLeaveThePoseToThePrior) {
  ASSERT_TRUE(Hold(40, 40.0, 60.0));
  EXPECT_FALSE(pose_.is_determined);
  EXPECT_LT(Along(pose_.cam_from_world), 0.05);
}

TEST_F(PointsInCorridorTest, TooFewPointsChangeNothing) {
  EXPECT_FALSE(Hold(4, 2.0, 6.0));
  EXPECT_TRUE(pose_.landmarks.points.empty());
  EXPECT_LT(Along(pose_.cam_from_world), 1e-3);
}

}  // namespace
}  // namespace msc_vo
