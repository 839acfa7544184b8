// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/results/report_paths.h"

#include <gmock/gmock.h>

#include "msc_vo/geometry/so3.h"

namespace msc_vo {
namespace {

using testing::ElementsAre;

const Rigid3 kToFromWorld(ExpSO3({0.3, -1.0, 0.7}), {1.0, 2.0, 3.0});

Rigid3 At(double x) { return Rigid3(Eigen::Quaterniond::Identity(), {-x, 0.0, 0.0}); }

FrameResult MakeFrame(double x, double x_in_odometry, int segment) {
  FrameResult frame;
  frame.status = TrackingStatus::kTracked;
  frame.segment = frame.world = segment;
  frame.cam_from_world = At(x);
  frame.cam_from_odometry = At(x_in_odometry) * Rigid3(ExpSO3({0.0, 0.2, 0.0}), {0.0, 0.0, 1.0});
  return frame;
}

TEST(OdometryPath, BeginsAtTheFirstPoseOfEachSegment) {
  std::vector<FrameResult> frames = {MakeFrame(0.0, 0.0, kNoSegment), MakeFrame(5.0, 1.0, 0),
                                     MakeFrame(6.1, 2.0, 0),          MakeFrame(6.1, 2.0, 0),
                                     MakeFrame(9.0, 2.0, 1),          MakeFrame(9.9, 3.0, 1)};
  const std::vector<Eigen::Vector3d> path = OdometryPath(frames, kToFromWorld);
  ASSERT_EQ(path.size(), frames.size());
  const auto expect_at = [&](int frame, double x) {
    EXPECT_LT((path[frame] - kToFromWorld * Eigen::Vector3d(x, 0.0, 0.0)).norm(), 1e-9) << frame;
  };
  EXPECT_FALSE(path[0].allFinite());
  expect_at(1, 5.0);
  expect_at(2, 6.0);                  // the drift of 0.1 is that of odometry
  EXPECT_FALSE(path[3].allFinite());  // the motion to the next segment is unknown
  expect_at(4, 9.0);
  expect_at(5, 10.0);
}

TEST(OdometryPath, BeginsWithAnEstimatedPose) {
  std::vector<FrameResult> frames = {MakeFrame(0.0, 0.0, 0), MakeFrame(1.0, 1.0, 0)};
  frames[0].status = TrackingStatus::kLost;
  const std::vector<Eigen::Vector3d> path = OdometryPath(frames, Rigid3());
  EXPECT_FALSE(path[0].allFinite());
  EXPECT_TRUE(path[1].allFinite());
}

TEST(EarlierSessions, AreThoseInTheWorldsOfTheRun) {
  OdometryResult result;
  result.frames = {MakeFrame(0.0, 0.0, 1), MakeFrame(0.0, 0.0, kNoSegment)};
  result.earlier_sessions = {{"monday", 0, {At(-1.0)}}, {"tuesday", 1, {At(-2.0), At(-3.0)}}};
  const std::vector<ReportSession> sessions = EarlierSessions(result, kToFromWorld);
  ASSERT_EQ(sessions.size(), 1u);
  EXPECT_EQ(sessions[0].name, "tuesday");
  EXPECT_THAT(sessions[0].positions, ElementsAre(kToFromWorld * Eigen::Vector3d(2.0, 0.0, 0.0),
                                                 kToFromWorld * Eigen::Vector3d(3.0, 0.0, 0.0)));
  result.frames.erase(result.frames.begin());  // no pose
  result.map_world = 0;
  EXPECT_EQ(EarlierSessions(result, kToFromWorld).at(0).name, "monday");
}

}  // namespace
}  // namespace msc_vo
