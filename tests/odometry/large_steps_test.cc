// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "tests/support/rendered_images.h"
#include <gtest/gtest.h>

#include "msc_vo/evaluation/trajectory_error.h"

namespace msc_vo {
namespace {

// An orbit around a box at 1.5 Hz, 15 cm and 8 degrees per image. Most corners are noise of the
// image on the plain floor.
SyntheticSequenceOptions Orbit(uint64_t seed, SyntheticDepth depth) {
  SyntheticSequenceOptions options;
  options.scene = SceneKind::kBox;
  options.seed = seed;
  options.fps = 1.5;
  options.path.speed = 0.25;
  options.image_sigma = 3.0;
  options.depth = depth;
  return options;
}

// White walls, which look alike, at half a second and up to 25 degrees per image.
SyntheticSequenceOptions BareRoom(uint64_t seed) {
  SyntheticSequenceOptions options;
  options.scene = SceneKind::kBare;
  options.seed = seed;
  options.fps = 2.0;
  return options;
}

void ExpectAllTracked(const SyntheticSequenceOptions& options, int num_frames) {
  const SyntheticSequence sequence(options);
  Odometry odometry(OdometryOptions(), sequence.camera(), LensDistortion());
  for (const RgbdImage& image : RenderImages(options, num_frames)) odometry.Process(image);
  const OdometryResult result = odometry.Finish();
  const Rigid3 truth_from_run =
      sequence.PoseAt(0).world_from_cam * result.frames.front().cam_from_world;
  for (int i = 0; i < num_frames; ++i) {
    EXPECT_EQ(result.frames[i].status, TrackingStatus::kTracked) << "frame " << i;
    const Rigid3 error = sequence.PoseAt(i).world_from_cam.Inverse() * truth_from_run *
                         result.frames[i].cam_from_world.Inverse();
    EXPECT_LT(error.translation().norm(), 0.03) << "frame " << i;
  }
}

TEST(LargeSteps, OrbitAroundBoxIsTracked) {
  for (const uint64_t seed : {1, 2}) ExpectAllTracked(Orbit(seed, SyntheticDepth::kExact), 12);
  ExpectAllTracked(Orbit(3, SyntheticDepth::kStructuredLight), 12);
}

TEST(LargeSteps, BareRoomIsTracked) { ExpectAllTracked(BareRoom(1), 10); }

}  // namespace
}  // namespace msc_vo
