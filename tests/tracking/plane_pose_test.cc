// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/tracking/plane_pose.h"

#include <cmath>

#include "tests/support/plane_features.h"
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

}  // namespace
}  // namespace msc_vo
