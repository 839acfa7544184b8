// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/results/streamed_pose.h"

#include <cmath>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace msc_vo {
namespace {

// A camera that looks along the x axis of the world, 2 m above its origin.
FrameResult WeakFrame() {
  FrameResult frame;
  frame.id = 7;
  frame.timestamp = 12.5;
  frame.status = TrackingStatus::kWeak;
  const Eigen::Quaterniond turned(Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitY()));
  frame.cam_from_world = Rigid3(turned, {0.0, 0.0, 2.0}).Inverse();
  // 1 cm and 2 mrad in the camera frame.
  frame.covariance = CovarianceOfCamera(frame.cam_from_world, IsotropicCovariance(0.002, 0.01));
  frame.world_covariance =
      CovarianceOfCamera(frame.cam_from_world, IsotropicCovariance(0.004, 0.03));
  frame.cam_from_odometry = Rigid3(turned, {0.0, 5.0, 0.0}).Inverse();
  frame.odometry_covariance =
      CovarianceOfCamera(frame.cam_from_odometry, IsotropicCovariance(0.008, 0.07));
  return frame;
}

TEST(StreamedPose, WritesTheCameraInTheWorld) {
  const std::string line = FormatStreamedPose(WeakFrame(), StreamedPoseForm::kText);
  EXPECT_EQ(line,
            "12.500000 0 0 2 0 0.707106781 0 0.707106781 0.01 0.01 0.01 0.002 0.002 0.002 weak "
            "0\n");
  const auto json = nlohmann::json::parse(FormatStreamedPose(WeakFrame(), StreamedPoseForm::kJson));
  EXPECT_EQ(json["time"], 12.5);
  EXPECT_EQ(json["frame"], 7);
  EXPECT_EQ(json["position"][2], 2.0);
  EXPECT_NEAR(json["orientation"][1].get<double>(), std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(json["sigma_rotation"][0].get<double>(), 0.002, 1e-9);
  EXPECT_NEAR(json["sigma_position"][2].get<double>(), 0.01, 1e-9);
  EXPECT_NEAR(json["world_sigma_rotation"][1].get<double>(), 0.004, 1e-9);
  EXPECT_NEAR(json["world_sigma_position"][0].get<double>(), 0.03, 1e-9);
  const auto& odometry = json["odometry"];
  EXPECT_NEAR(odometry["position"][1].get<double>(), 5.0, 1e-12);
  EXPECT_NEAR(odometry["sigma_rotation"][0].get<double>(), 0.008, 1e-9);
  EXPECT_NEAR(odometry["sigma_position"][2].get<double>(), 0.07, 1e-9);
  EXPECT_FALSE(json.contains("world_changed"));
}

TEST(StreamedPose, SaysWhatIsNotKnown) {
  FrameResult frame = WeakFrame();
  frame.covariance.reset();
  frame.world_covariance.reset();
  frame.odometry_covariance.reset();
  EXPECT_THAT(FormatStreamedPose(frame, StreamedPoseForm::kText),
              testing::HasSubstr(" nan nan nan nan nan nan weak 0\n"));
  EXPECT_THAT(FormatStreamedPose(frame, StreamedPoseForm::kJson),
              testing::Not(testing::HasSubstr("sigma")));
  frame.status = TrackingStatus::kLost;  // its pose is that of the frame before
  EXPECT_THAT(FormatStreamedPose(frame, StreamedPoseForm::kText),
              testing::StartsWith("12.500000 nan nan nan nan"));
  EXPECT_THAT(FormatStreamedPose(frame, StreamedPoseForm::kJson),
              testing::Not(testing::HasSubstr("position")));
}

TEST(StreamedPose, SaysHowTheWorldChanges) {
  FrameResult frame = WeakFrame();
  frame.world_changed = WorldChange{3, Rigid3(Eigen::Quaterniond::Identity(), {1.0, 0.0, 0.0})};
  const auto json = nlohmann::json::parse(FormatStreamedPose(frame, StreamedPoseForm::kJson));
  EXPECT_EQ(json["world_changed"]["old_world"], 3);
  EXPECT_EQ(json["world_changed"]["position"][0], 1.0);
}

}  // namespace
}  // namespace msc_vo
