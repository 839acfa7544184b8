// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/pose_estimation/relocalizer.h"

#include "tests/support/synthetic_frames.h"
#include "tests/support/synthetic_map.h"
#include <gmock/gmock.h>

namespace msc_vo {
namespace {

TEST(Relocalizer, EstimatesAPoseWithoutPrediction) {
  SyntheticFrames world{SyntheticFrames::Options()};
  const MapSnapshot snapshot =
      MapOfOneKeyframe(world.MakeFrame(0), SyntheticFrames::CamFromWorld(0));
  const Rigid3 truth = SyntheticFrames::CamFromWorld(60);
  const std::shared_ptr<const Frame> frame = world.MakeFrame(60);
  const auto hit = Relocalize(RelocalizerOptions(), LineMatcherOptions(), *frame, snapshot.map,
                              snapshot.map.keyframes().front().second);
  ASSERT_TRUE(hit.has_value());
  // From three noisy matches at 2 to 6 m: good enough to start pose optimisation.
  EXPECT_LT(PositionError(hit->cam_from_world, truth), 0.15);
  EXPECT_GT(hit->matches.points.size(), 50u);
}

TEST(Relocalizer, IsDeterministic) {
  SyntheticFrames world{SyntheticFrames::Options()};
  const MapSnapshot snapshot =
      MapOfOneKeyframe(world.MakeFrame(0), SyntheticFrames::CamFromWorld(0));
  const std::shared_ptr<const Frame> frame = world.MakeFrame(30);
  const Keyframe& keyframe = snapshot.map.keyframes().front().second;
  const auto a =
      Relocalize(RelocalizerOptions(), LineMatcherOptions(), *frame, snapshot.map, keyframe);
  const auto b =
      Relocalize(RelocalizerOptions(), LineMatcherOptions(), *frame, snapshot.map, keyframe);
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->cam_from_world.params, b->cam_from_world.params);
}

TEST(Relocalizer, RejectsAnotherSceneAndAnEmptyFrame) {
  SyntheticFrames world{SyntheticFrames::Options()};
  SyntheticFrames::Options other_options;
  other_options.seed = 99;
  SyntheticFrames other(other_options);
  const MapSnapshot snapshot =
      MapOfOneKeyframe(world.MakeFrame(0), SyntheticFrames::CamFromWorld(0));
  const Keyframe& keyframe = snapshot.map.keyframes().front().second;
  EXPECT_FALSE(Relocalize(RelocalizerOptions(), LineMatcherOptions(), *other.MakeFrame(0),
                          snapshot.map, keyframe));
  EXPECT_FALSE(Relocalize(RelocalizerOptions(), LineMatcherOptions(),
                          *SyntheticFrames::MakeEmptyFrame(3), snapshot.map, keyframe));
}

}  // namespace
}  // namespace msc_vo
