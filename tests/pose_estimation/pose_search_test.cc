// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <algorithm>
#include <memory>

#include "tests/support/synthetic_frames.h"
#include "tests/support/synthetic_map.h"
#include <gtest/gtest.h>

#include "msc_vo/geometry/angles.h"
#include "msc_vo/pose_estimation/relocalizer.h"

namespace msc_vo {
namespace {

// A large step: 0.4 metres and 25 degrees.
const Rigid3 kMoved =
    Rigid3(Eigen::Quaterniond(Eigen::AngleAxisd(DegreesToRadians(25.0),
                                                Eigen::Vector3d(0.2, 1.0, 0.1).normalized())),
           {-0.4, 0.05, 0.1});

// The features of `frame` at `cam_from_world` as candidates.
LocalMap Candidates(const Frame& frame, const Rigid3& cam_from_world) {
  const Rigid3 world_from_cam = cam_from_world.Inverse();
  LocalMap candidates;
  for (int i = 0; i < static_cast<int>(frame.points.size()); ++i) {
    PointCandidate candidate;
    candidate.position = world_from_cam * frame.PointInCamera(i);
    candidate.descriptor = frame.points[i].descriptor;
    candidates.points.push_back(candidate);
  }
  for (int i = 0; i < static_cast<int>(frame.lines.size()); ++i) {
    LineCandidate candidate;
    candidate.segment = world_from_cam * frame.LineInCamera(i);
    candidate.descriptor = frame.lines[i].descriptor;
    candidates.lines.push_back(candidate);
  }
  return candidates;
}

std::vector<Relocalization> Search(SyntheticFrames* world, const Rigid3& truth) {
  const LocalMap candidates = Candidates(*world->MakeFrame(0, Rigid3()), Rigid3());
  return FindPoses(RelocalizerOptions(), LineMatcherOptions(), *world->MakeFrame(1, truth),
                   candidates, 3);
}

SyntheticFrames World(int num_points, int num_lines) {
  SyntheticFrames::Options options;
  options.num_points = num_points;
  options.num_lines = num_lines;
  return SyntheticFrames(options);
}

TEST(FindPoses, FindsPoseFromLinesAlone) {
  SyntheticFrames world = World(0, 20);
  const std::vector<Relocalization> poses = Search(&world, kMoved);
  ASSERT_FALSE(poses.empty());
  EXPECT_LT(PositionError(poses[0].cam_from_world, kMoved), 0.1);
  EXPECT_LT(RadiansToDegrees(RotationError(poses[0].cam_from_world, kMoved)), 2.0);
  EXPECT_TRUE(poses[0].matches.points.empty());
  EXPECT_GE(poses[0].matches.lines.size(), 6u);
}

TEST(FindPoses, FindsPoseFromPointsAlone) {
  SyntheticFrames world = World(100, 0);
  const std::vector<Relocalization> poses = Search(&world, kMoved);
  ASSERT_FALSE(poses.empty());
  EXPECT_LT(PositionError(poses[0].cam_from_world, kMoved), 0.1);
}

// Two points and a line determine no pose by points alone, nor by lines alone.
TEST(FindPoses, CombinesLinesWithPoints) {
  SyntheticFrames::Options exact;
  exact.num_points = 8;
  exact.num_lines = 4;
  exact.pixel_noise = exact.inverse_depth_noise = 1e-6;
  SyntheticFrames world(exact);
  const LocalMap candidates = Candidates(*world.MakeFrame(0, Rigid3()), Rigid3());
  Frame frame = *world.MakeFrame(1, kMoved);
  frame.points.resize(std::min<size_t>(frame.points.size(), 2));
  frame.lines.resize(std::min<size_t>(frame.lines.size(), 1));
  ASSERT_EQ(frame.points.size(), 2u);
  ASSERT_EQ(frame.lines.size(), 1u);
  RelocalizerOptions options;
  options.min_inliers = 4;
  const std::vector<Relocalization> poses =
      FindPoses(options, LineMatcherOptions(), frame, candidates, 1);
  ASSERT_FALSE(poses.empty());
  EXPECT_LT(PositionError(poses[0].cam_from_world, kMoved), 1e-3);
}

TEST(FindPoses, FindsNothingInAnotherScene) {
  SyntheticFrames::Options options;
  options.seed = 99;
  SyntheticFrames other(options);
  SyntheticFrames world = World(300, 40);
  const LocalMap candidates = Candidates(*other.MakeFrame(0, Rigid3()), Rigid3());
  EXPECT_TRUE(FindPoses(RelocalizerOptions(), LineMatcherOptions(), *world.MakeFrame(0, Rigid3()),
                        candidates, 3)
                  .empty());
}

// Squares of lines with equal descriptors, which look the same after a quarter turn.
std::shared_ptr<Frame> MakeSquares() {
  auto frame = std::make_shared<Frame>(*SyntheticFrames::MakeEmptyFrame(0));
  const Eigen::Vector2d center(frame->camera.cx, frame->camera.cy);
  for (const double half : {60.0, 90.0, 120.0}) {
    const Eigen::Vector2d corners[] = {{-half, -half}, {half, -half}, {half, half}, {-half, half}};
    for (int i = 0; i < 4; ++i) {
      LineFeature line;
      line.segment = {center + corners[i], center + corners[(i + 1) % 4]};
      LineDepth depth;
      depth.start = depth.end = 0.5;
      depth.covariance = 1e-6 * Eigen::Matrix2d::Identity();
      line.depth = depth;
      frame->lines.push_back(line);
    }
  }
  return frame;
}

TEST(FindPoses, ReturnsDifferentPosesBestFirst) {
  const std::shared_ptr<Frame> frame = MakeSquares();
  const LocalMap candidates = Candidates(*frame, Rigid3());
  const std::vector<Relocalization> poses =
      FindPoses(RelocalizerOptions(), LineMatcherOptions(), *frame, candidates, 4);
  ASSERT_GE(poses.size(), 2u);
  for (size_t i = 1; i < poses.size(); ++i) {
    EXPECT_LE(poses[i].score, poses[i - 1].score);
    EXPECT_GT(RotationError(poses[i].cam_from_world, poses[0].cam_from_world),
              DegreesToRadians(80.0));
  }
}

TEST(Relocalize, RefusesToChooseBetweenPosesThatLookAlike) {
  const std::shared_ptr<Frame> frame = MakeSquares();
  const MapSnapshot snapshot = MapOfOneKeyframe(frame, Rigid3());
  const Keyframe& keyframe = snapshot.map.keyframes().front().second;
  EXPECT_FALSE(
      Relocalize(RelocalizerOptions(), LineMatcherOptions(), *frame, snapshot.map, keyframe)
          .has_value());
  // With a difference between the sides it is found.
  for (size_t i = 0; i < frame->lines.size(); i += 4) frame->lines[i].descriptor.fill(0xff);
  const MapSnapshot marked = MapOfOneKeyframe(frame, Rigid3());
  const auto found = Relocalize(RelocalizerOptions(), LineMatcherOptions(), *frame, marked.map,
                                marked.map.keyframes().front().second);
  ASSERT_TRUE(found.has_value());
  EXPECT_LT(PositionError(found->cam_from_world, Rigid3()), 0.05);
}

}  // namespace
}  // namespace msc_vo
