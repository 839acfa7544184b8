// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/mapping/mapper.h"

#include <cmath>

#include "tests/support/synthetic_keyframes.h"
#include "tests/support/synthetic_map.h"
#include <gmock/gmock.h>

namespace msc_vo {
namespace {

TEST(Mapper, CreatesLandmarksFromAllFeaturesOfTheFirstKeyframe) {
  SyntheticFrames world{SyntheticFrames::Options()};
  std::mt19937 random(1);
  Mapper mapper{MapperOptions()};
  const KeyframePacket packet = Packet(&world, 0, &random);
  mapper.Process(packet);
  EXPECT_EQ(mapper.map().keyframes().size(), 1u);
  EXPECT_EQ(mapper.map().points().size(), packet.frame->points.size());
  EXPECT_EQ(mapper.map().lines().size(), packet.frame->lines.size());
}

TEST(Mapper, CreatesNoLandmarksOnDynamicObjects) {
  SyntheticFrames world{SyntheticFrames::Options()};
  std::mt19937 random(1);
  Mapper mapper{MapperOptions()};
  KeyframePacket packet = Packet(&world, 0, &random);
  auto marked = std::make_shared<Frame>(*packet.frame);
  marked->points[3].dynamic = true;
  marked->lines[1].dynamic = true;
  packet.frame = marked;
  mapper.Process(packet);
  EXPECT_EQ(mapper.map().points().size(), marked->points.size() - 1);
  EXPECT_EQ(mapper.map().lines().size(), marked->lines.size() - 1);
  EXPECT_EQ(mapper.map().FindKeyframe(0)->landmarks.points[3], kNoId);
  EXPECT_EQ(mapper.map().FindKeyframe(0)->landmarks.lines[1], kNoId);
}

TEST(Mapper, CorrectsPoseErrorsByBundleAdjustment) {
  SyntheticFrames world{SyntheticFrames::Options()};
  std::mt19937 random(1);
  Mapper mapper{MapperOptions()};
  double error_before = 0.0;
  double error_after = 0.0;
  MappingSummary summary;
  for (int index = 0; index <= 60; index += 10) {
    KeyframePacket packet = Packet(&world, index, &random);
    MatchWithMap(mapper.map(), &packet);
    summary = mapper.Process(packet);
    const Rigid3 truth =
        SyntheticFrames::CamFromWorld(index) * SyntheticFrames::CamFromWorld(0).Inverse();
    error_before += PositionError(packet.cam_from_reference, truth);
    error_after += PositionError(mapper.map().CamFromWorld(summary.keyframe), truth);
  }
  EXPECT_LT(error_after, 0.5 * error_before);
  ASSERT_TRUE(summary.window.has_value());
  EXPECT_TRUE(summary.window->usable);
  EXPECT_LT(summary.window->final_cost, summary.window->initial_cost);
  EXPECT_GT(summary.window->line_reprojection.num_residual_blocks, 0);
  // The keyframes observe the same landmarks, so that the map does not grow with them.
  EXPECT_LT(mapper.map().points().size(), 400u);
  EXPECT_LT(mapper.map().lines().size(), 80u);
}

TEST(Mapper, CompensatesKeyframesWhoseVelocityIsKnown) {
  SyntheticFrames world{SyntheticFrames::Options()};
  std::mt19937 random(1);
  MapperOptions options;
  options.readout_time = 0.026;
  Mapper mapper{options};
  const CameraVelocity velocity{{0.5, 0.0, 0.0}, {0.0, 0.1, 0.0}};
  mapper.Process(Packet(&world, 0, &random));
  EXPECT_EQ(mapper.Snapshot()->readout_time, 0.026);
  EXPECT_EQ(mapper.map().FindKeyframe(0)->frame->readout_time, 0.0);  // unknown velocity
  for (const int index : {10, 20}) {
    KeyframePacket packet = Packet(&world, index, &random);
    packet.last_keyframe = index / 10 - 1;
    packet.last_velocity = velocity;
    mapper.Process(packet);
  }
  for (const KeyframeId id : {0, 1}) {
    const Frame& frame = *mapper.map().FindKeyframe(id)->frame;
    EXPECT_EQ(frame.readout_time, 0.026);
    EXPECT_EQ(frame.velocity->angular, velocity.angular);
  }
  KeyframePacket after_failure = Packet(&world, 30, &random);
  after_failure.last_keyframe = 7;  // which could not be inserted
  after_failure.last_velocity = velocity;
  mapper.Process(after_failure);
  EXPECT_FALSE(mapper.map().FindKeyframe(2)->frame->velocity.has_value());
}

TEST(Mapper, MovesLandmarksWithTheCompensationOfTheFirstKeyframe) {
  SyntheticFrames world{SyntheticFrames::Options()};
  std::mt19937 random(1);
  MapperOptions options;
  options.readout_time = 0.026;
  Mapper mapper{options};
  mapper.Process(Packet(&world, 0, &random));
  const std::shared_ptr<const Frame> raw = mapper.map().FindKeyframe(0)->frame;
  KeyframePacket packet = Packet(&world, 10, &random);
  packet.last_keyframe = 0;
  packet.last_velocity = CameraVelocity{{0.5, 0.0, 0.0}, {0.0, 0.1, 0.0}};
  KeyframeTask task(packet);
  while (!task.IsInserted()) mapper.Advance(&task);
  const Keyframe& first = *mapper.map().FindKeyframe(0);
  double largest_move = 0.0;
  for (size_t i = 0; i < first.landmarks.points.size(); ++i) {
    const int feature = static_cast<int>(i);
    const PointLandmark* point = mapper.map().Find<PointLandmark>(first.landmarks.points[i]);
    if (point == nullptr) continue;
    EXPECT_EQ(point->position, first.frame->PointInCamera(feature)) << i;
    largest_move = std::max(largest_move, (point->position - raw->PointInCamera(feature)).norm());
  }
  // 0.5 rad/s over half of 26 ms displace by 6.5 mm per metre of depth.
  EXPECT_GT(largest_move, 0.006);
}

TEST(Mapper, TakesImmutableSnapshots) {
  SyntheticFrames world{SyntheticFrames::Options()};
  std::mt19937 random(1);
  Mapper mapper{MapperOptions()};
  mapper.Process(Packet(&world, 0, &random));
  const MapSnapshotPtr snapshot = mapper.Snapshot();
  mapper.Process(Packet(&world, 10, &random));
  EXPECT_EQ(snapshot->map.keyframes().size(), 1u);
  EXPECT_EQ(snapshot->newest_keyframe, 0);
  EXPECT_EQ(mapper.Snapshot()->newest_keyframe, 1);
}

TEST(Mapper, PassesTheExactWindowToItsObserver) {
  SyntheticFrames world{SyntheticFrames::Options()};
  std::mt19937 random(1);
  MapperOptions options;
  options.window.second_iterations = 7;
  Mapper mapper(options);
  std::vector<KeyframeId> keyframes;
  BundleAdjustmentOptions observed_options;
  WindowData observed;
  mapper.SetWindowObserver([&](KeyframeId keyframe, const BundleAdjustmentOptions& window_options,
                               const WindowData& window) {
    keyframes.push_back(keyframe);
    observed_options = window_options;
    observed = window;
  });
  MappingSummary summary;
  for (int index = 0; index <= 30; index += 10) {
    summary = ProcessKeyframe(&world, index, &random, &mapper);
  }
  ASSERT_TRUE(summary.window && summary.window->usable);
  EXPECT_THAT(keyframes, testing::ElementsAre(1, 2, 3));  // one keyframe makes no window
  EXPECT_EQ(observed_options.second_iterations, 7);

  const WindowData before = observed;
  const BundleAdjustmentSummary repeated = LocalBundleAdjustment(observed_options, &observed);
  EXPECT_EQ(repeated.initial_cost, summary.window->initial_cost);
  EXPECT_EQ(repeated.final_cost, summary.window->final_cost);
  ASSERT_EQ(observed.keyframes.size(), 4u);
  for (size_t i = 0; i < observed.keyframes.size(); ++i) {
    const auto& [id, cam_from_world, fixed] = observed.keyframes[i];
    EXPECT_EQ(cam_from_world.params, mapper.map().CamFromWorld(id).params);
    EXPECT_EQ(cam_from_world.params == before.keyframes[i].cam_from_world.params, fixed);
  }
}

// Keyframes from frames 0, 2, ..., 10 at 30 Hz. The first window is that of frame 2; frames 4 and 6
// follow within 0.15 s, frame 8 after 0.2 s.
TEST(Mapper, WaitsForTheIntervalBetweenWindows) {
  SyntheticFrames world{SyntheticFrames::Options()};
  std::mt19937 random(1);
  MapperOptions options;
  options.min_window_interval = 0.15;
  Mapper mapper{options};
  std::vector<KeyframeId> with_window;
  for (int index = 0; index <= 10; index += 2) {
    const MappingSummary summary = ProcessKeyframe(&world, index, &random, &mapper);
    if (summary.window) with_window.push_back(summary.keyframe);
  }
  EXPECT_THAT(with_window, testing::ElementsAre(1, 4));
  EXPECT_EQ(mapper.Snapshot()->newest_keyframe, 5);  // inserted without a window
}

TEST(Mapper, BoundsTheMapOfOnePlace) {
  SyntheticFrames world{SyntheticFrames::Options()};
  std::mt19937 random(1);
  Mapper mapper{MapperOptions()};
  // Forty keyframes along the same short trajectory, again and again.
  for (int i = 0; i < 40; ++i) {
    ProcessKeyframe(&world, 3 * (i % 10), &random, &mapper);
  }
  EXPECT_LT(mapper.map().keyframes().size(), 20u);
  EXPECT_LT(mapper.map().points().size(), 500u);
}

TEST(Mapper, RequestsNormalsUntilTheAxesAreKnown) {
  SyntheticFrames world{SyntheticFrames::Options()};
  Mapper mapper{MapperOptions()};
  EXPECT_TRUE(mapper.Snapshot()->needs_axes);
  KeyframePacket packet;
  packet.frame = world.MakeFrame(0);
  mapper.Process(packet);
  EXPECT_FALSE(mapper.Snapshot()->needs_axes);
}

// Root mean square of the sines of the angles between the lines of the map and the nearest axis of
// the box.
double DirectionErrorOfTheMap(bool frame_structure, unsigned seed) {
  SyntheticFrames::Options frames;
  frames.seed = seed;
  SyntheticFrames world{frames};
  MapperOptions options;
  options.frame_structure = frame_structure;
  options.structure.max_angle = 5.0;
  Mapper mapper(options);
  KeyframePacket packet;
  packet.frame = world.MakeFrame(0);
  packet.cam_from_reference = SyntheticFrames::CamFromWorld(0);
  mapper.Process(packet);
  double squares = 0.0;
  for (const auto& [id, line] : mapper.map().lines()) {
    const double cosine = line.segment.Direction().cwiseAbs().maxCoeff();
    squares += 1.0 - cosine * cosine;
  }
  return std::sqrt(squares / static_cast<double>(mapper.map().lines().size()));
}

TEST(Mapper, RefinesLinesOfKeyframesAsTheOptionsRequire) {
  double with = 0.0, without = 0.0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    with += DirectionErrorOfTheMap(true, seed);
    without += DirectionErrorOfTheMap(false, seed);
  }
  EXPECT_LT(with, 0.75 * without);
}

}  // namespace
}  // namespace msc_vo
