// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/synthetic/scene/synthetic_sequence.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "msc_vo/synthetic/scene/camera_path.h"
#include "msc_vo/synthetic/scene/renderer.h"

namespace msc_vo {
namespace {

SyntheticSequenceOptions Small() {
  SyntheticSequenceOptions options;
  options.width = 160;
  options.height = 120;
  return options;
}

TEST(SyntheticSequenceTest, IsDeterministicInAnyOrder) {
  SyntheticSequenceOptions options = Small();
  options.kinect_depth = true;
  const SyntheticSequence a(options), b(options);
  const SyntheticFrame late = a.Render(9), early = a.Render(2);
  const SyntheticFrame early_again = b.Render(2), late_again = b.Render(9);
  EXPECT_EQ(late.image.rgb, late_again.image.rgb);
  EXPECT_EQ(late.image.depth, late_again.image.depth);
  EXPECT_EQ(early.image.rgb, early_again.image.rgb);
  EXPECT_EQ(early.pose.world_from_cam.params, early_again.pose.world_from_cam.params);
  EXPECT_NE(early.image.rgb, late.image.rgb);
}

TEST(SyntheticSequenceTest, ChangesWithSeed) {
  SyntheticSequenceOptions options = Small();
  const SyntheticFrame a = SyntheticSequence(options).Render(0);
  options.seed = 2;
  const SyntheticFrame b = SyntheticSequence(options).Render(0);
  EXPECT_NE(a.image.rgb, b.image.rgb);
  EXPECT_NE(a.image.depth, b.image.depth);
}

TEST(SyntheticSequenceTest, TimeStampsFollowFrameRate) {
  SyntheticSequenceOptions options = Small();
  options.fps = 15.0;
  const SyntheticSequence sequence(options);
  EXPECT_DOUBLE_EQ(sequence.PoseAt(0).timestamp, 1.0);
  EXPECT_DOUBLE_EQ(sequence.PoseAt(30).timestamp, 3.0);
}

TEST(SyntheticSequenceTest, DepthDelayRendersDepthLater) {
  SyntheticSequenceOptions options = Small();
  const SyntheticSequence at_once(options);
  options.depth_delay = 0.25 / options.fps;
  const SyntheticSequence delayed(options);
  options.depth_delay = 0.0;
  options.fps *= 4.0;
  const SyntheticSequence fine(options);
  EXPECT_EQ(delayed.Render(3).image.rgb, at_once.Render(3).image.rgb);
  EXPECT_NE(delayed.Render(3).image.depth, at_once.Render(3).image.depth);
  EXPECT_EQ(delayed.Render(3).image.depth, fine.Render(13).image.depth);
  EXPECT_DOUBLE_EQ(delayed.PoseAt(3).timestamp, at_once.PoseAt(3).timestamp);
}

TEST(SyntheticSequenceTest, GlobalShutterRendersPose) {
  SyntheticSequenceOptions options = Small();
  options.image_sigma = 0.0;
  const SyntheticSequence sequence(options);
  const SyntheticFrame frame = sequence.Render(3);
  const RenderedImage image =
      Renderer(sequence.scene(), sequence.camera()).Render(frame.pose.world_from_cam.Inverse());
  EXPECT_EQ(frame.image.rgb, image.rgb);
  EXPECT_EQ(frame.image.depth, image.depth);
}

TEST(SyntheticSequenceTest, RollingShutterRendersEveryRowAtItsTime) {
  SyntheticSequenceOptions options = Small();
  options.width = 64;
  options.height = 48;
  options.fps = 4.0;  // slow, so the motion within half a row (2.6 ms) is visible
  options.image_sigma = 0.0;
  options.depth_delay = 0.1;
  const SyntheticSequence global(options);
  const Renderer renderer(global.scene(), global.camera());
  const CameraPath path(global.scene(), options.path);
  for (const double readout_time : {0.25, -0.25}) {
    options.readout_time = readout_time;
    const SyntheticSequence rolling(options);
    const SyntheticFrame frame = rolling.Render(3);
    EXPECT_EQ(frame.pose.timestamp, global.PoseAt(3).timestamp);
    EXPECT_EQ(frame.pose.world_from_cam.params, global.PoseAt(3).world_from_cam.params);
    for (const int row : {0, 1, 12, 24, 46, 47}) {
      const double seconds = 0.75 + readout_time * ((row + 0.5) / 48.0 - 0.5);
      const RenderedImage color = renderer.Render(path.CamFromWorld(seconds));
      const RenderedImage depth = renderer.Render(path.CamFromWorld(seconds + 0.1));
      for (int i = 64 * row; i < 64 * (row + 1); ++i) {
        ASSERT_NEAR(frame.image.depth[i], depth.depth[i], 1e-5) << row;
        for (int k = 3 * i; k < 3 * i + 3; ++k) {
          ASSERT_NEAR(frame.image.rgb[k], color.rgb[k], 1) << row;
        }
      }
    }
  }
}

// Sum of the differences between neighbouring pixels.
int64_t Contrast(const RenderedImage& image) {
  const std::vector<uint8_t> gray = image.Gray();
  int64_t sum = 0;
  for (size_t i = 1; i < gray.size(); ++i) sum += std::abs(gray[i] - gray[i - 1]);
  return sum;
}

TEST(SyntheticSequenceTest, MotionBlurSmoothsColourOnly) {
  SyntheticSequenceOptions options = Small();
  options.image_sigma = 0.0;
  options.fps = 5.0;
  const SyntheticFrame sharp = SyntheticSequence(options).Render(3);
  options.motion_blur = 0.5;
  const SyntheticFrame blurred = SyntheticSequence(options).Render(3);
  EXPECT_LT(Contrast(blurred.image), 0.8 * Contrast(sharp.image));
  EXPECT_EQ(blurred.image.depth, sharp.image.depth);
  EXPECT_EQ(blurred.pose.world_from_cam.params, sharp.pose.world_from_cam.params);
  // It is symmetric in time, so that the image does not move: a shift to either side is farther
  // from the sharp image than none.
  const std::vector<uint8_t> a = sharp.image.Gray(), b = blurred.image.Gray();
  int64_t differences[3] = {};
  for (size_t i = 2; i + 2 < a.size(); ++i) {
    for (int shift = -1; shift <= 1; ++shift) {
      differences[shift + 1] += std::abs(a[i + 2 * shift] - b[i]);
    }
  }
  EXPECT_LT(differences[1], differences[0]);
  EXPECT_LT(differences[1], differences[2]);
}

TEST(SyntheticSequenceTest, MotionBlurNeedsMotion) {
  SyntheticSequenceOptions options = Small();
  options.image_sigma = 0.0;
  const SyntheticFrame sharp = SyntheticSequence(options).Render(3);
  options.motion_blur = 1e-3;
  EXPECT_EQ(SyntheticSequence(options).Render(3).image.rgb, sharp.image.rgb);
}

TEST(SyntheticSequenceTest, DepthFactorScalesRecordedDepth) {
  SyntheticSequenceOptions options = Small();
  options.depth = SyntheticDepth::kStructuredLight;
  const SyntheticFrame right = SyntheticSequence(options).Render(3);
  options.depth_factor = 1.02;
  const SyntheticFrame wrong = SyntheticSequence(options).Render(3);
  EXPECT_EQ(wrong.image.rgb, right.image.rgb);
  for (size_t i = 0; i < right.image.depth.size(); ++i) {
    ASSERT_FLOAT_EQ(wrong.image.depth[i], 1.02f * right.image.depth[i]);
  }
}

TEST(SyntheticSequenceTest, DimLightAndHuntingExposureChangeColourOnly) {
  const SyntheticFrame plain = SyntheticSequence(Small()).Render(14);
  SyntheticSequenceOptions options = Small();
  options.light = 0.1;
  const SyntheticFrame dim = SyntheticSequence(options).Render(14);
  EXPECT_GT(Contrast(dim.image), 2 * Contrast(plain.image));
  EXPECT_EQ(dim.image.depth, plain.image.depth);
  options = Small();
  options.hunting_exposure = true;
  const SyntheticFrame bright = SyntheticSequence(options).Render(14);  // 0.47 s: most gain
  const size_t center = 3 * (60 * 160 + 80);
  EXPECT_GT(bright.image.rgb[center], std::min(255, plain.image.rgb[center] + 40) - 1);
  EXPECT_EQ(bright.image.depth, plain.image.depth);
}

TEST(SyntheticSequenceTest, DepthIsConsistentBetweenFrames) {
  SyntheticSequenceOptions options = Small();
  options.image_sigma = 0.0;
  for (const SceneKind kind : {SceneKind::kRoom, SceneKind::kSlanted}) {
    options.scene = kind;
    const SyntheticSequence sequence(options);
    const SyntheticFrame a = sequence.Render(0), b = sequence.Render(10);
    const Rigid3 b_from_a = b.pose.world_from_cam.Inverse() * a.pose.world_from_cam;
    const PinholeCamera& camera = sequence.camera();
    int visible = 0, agree = 0;
    for (int i = 0; i < camera.width * camera.height; ++i) {
      const Eigen::Vector2d pixel(i % camera.width, i / camera.width);
      const Eigen::Vector3d x = b_from_a * camera.BackProject(pixel, a.image.depth[i]);
      if (x.z() < 0.1 || !camera.IsInside(camera.Project(x))) continue;
      const Eigen::Vector2d there = camera.Project(x);
      const int j = static_cast<int>(std::lround(there.y())) * camera.width +
                    static_cast<int>(std::lround(there.x()));
      ++visible;
      agree += std::abs(b.image.depth[j] - x.z()) < 0.02 * x.z() ? 1 : 0;
    }
    EXPECT_GT(visible, camera.width * camera.height / 2);
    EXPECT_GT(agree, 0.93 * visible);  // the others are occluded or beside an edge
  }
}

TEST(SyntheticSequenceTest, KinectDepthHasPlausibleRatioOfMissingPixels) {
  SyntheticSequenceOptions options = Small();
  options.kinect_depth = true;
  const SyntheticSequence sequence(options);
  for (int i = 0; i < 200; i += 50) {
    const std::vector<float> depth = sequence.Render(i).image.depth;
    const auto missing = std::count(depth.begin(), depth.end(), 0.0f);
    EXPECT_GT(missing, 0.005 * depth.size());
    EXPECT_LT(missing, 0.4 * depth.size());
  }
}

TEST(SyntheticSequenceTest, ImagesAreWellExposed) {
  for (const SceneKind kind : {SceneKind::kRoom, SceneKind::kCorridor, SceneKind::kBare,
                               SceneKind::kSlanted, SceneKind::kHouse, SceneKind::kBox}) {
    SyntheticSequenceOptions options = Small();
    options.scene = kind;
    const SyntheticSequence sequence(options);
    for (int i = 0; i < 300; i += 100) {
      const std::vector<uint8_t> gray = sequence.Render(i).image.Gray();
      double mean = 0.0;
      for (const uint8_t value : gray) mean += value / static_cast<double>(gray.size());
      EXPECT_GT(mean, 60.0) << static_cast<int>(kind) << " frame " << i;
      EXPECT_LT(mean, 200.0) << static_cast<int>(kind) << " frame " << i;
    }
  }
}

TEST(SyntheticSequenceTest, ThrowsOnInvalidOptions) {
  SyntheticSequenceOptions options = Small();
  options.width = 3;
  EXPECT_THROW(SyntheticSequence{options}, std::invalid_argument);
  options = Small();
  options.fps = 0.0;
  EXPECT_THROW(SyntheticSequence{options}, std::invalid_argument);
  options = Small();
  options.path.speed = -1.0;
  EXPECT_THROW(SyntheticSequence{options}, std::invalid_argument);
  options = Small();
  options.motion_blur = 1.1;
  EXPECT_THROW(SyntheticSequence{options}, std::invalid_argument);
  options = Small();
  options.depth_factor = 0.0;
  EXPECT_THROW(SyntheticSequence{options}, std::invalid_argument);
  options = Small();
  for (const double light : {0.0, -0.1, 1.1, std::nan("")}) {
    options.light = light;
    EXPECT_THROW(SyntheticSequence{options}, std::invalid_argument) << light;
  }
}

TEST(SyntheticSequenceTest, RejectsReadoutTimeAboveFrameInterval) {
  SyntheticSequenceOptions options = Small();
  options.fps = 20.0;
  for (const double readout_time : {0.05, -0.05}) {
    options.readout_time = readout_time;
    EXPECT_NO_THROW(SyntheticSequence{options}) << readout_time;
  }
  for (const double readout_time : {0.051, -0.051, std::nan("")}) {
    options.readout_time = readout_time;
    std::string error;
    EXPECT_FALSE(options.IsValid(&error)) << readout_time;
    EXPECT_THAT(error, testing::HasSubstr("readout_time")) << readout_time;
    EXPECT_THROW(SyntheticSequence{options}, std::invalid_argument) << readout_time;
  }
}

// Specific force, rotated to the world and integrated over time, is the change of velocity plus the
// upward reaction to gravity.
TEST(SyntheticSequenceTest, AccelerometerAgreesWithTheTrajectory) {
  SyntheticSequenceOptions options = Small();
  options.fps = 100.0;  // a pose for each reading
  options.accelerometer_sigma = 0.0;
  const SyntheticSequence sequence(options);
  constexpr int kFrames = 301;
  const std::vector<TimedAcceleration> readings = sequence.AccelerometerReadings(kFrames);
  ASSERT_EQ(readings.size(), size_t{kFrames});
  const auto velocity = [&](int i) -> Eigen::Vector3d {
    const Rigid3 before = sequence.PoseAt(i - 5).world_from_cam;
    const Rigid3 after = sequence.PoseAt(i + 5).world_from_cam;
    return (after.translation() - before.translation()) / 0.1;
  };
  constexpr int kFirst = 10, kLast = 290;
  Eigen::Vector3d integral = Eigen::Vector3d::Zero();
  for (int i = kFirst; i < kLast; ++i) {
    const TimedPose pose = sequence.PoseAt(i);
    EXPECT_NEAR(readings[i].timestamp, pose.timestamp, 1e-9);
    integral += 0.01 * (pose.world_from_cam.rotation() * readings[i].acceleration);
  }
  const Eigen::Vector3d gravity =
      (integral - velocity(kLast) + velocity(kFirst)) / (0.01 * (kLast - kFirst));
  EXPECT_NEAR(gravity.x(), 0.0, 0.02);
  EXPECT_NEAR(gravity.y(), 0.0, 0.02);
  EXPECT_NEAR(gravity.z(), 9.81, 0.02);
}

TEST(SyntheticSequenceTest, OtherPathsShowTheSameSceneWithOtherNoise) {
  for (const SceneKind scene : {SceneKind::kRoom, SceneKind::kDesks}) {
    SyntheticSequenceOptions options = Small();
    options.scene = scene;
    options.image_sigma = 0.0;
    const SyntheticSequence first(options);
    options.walk.path = 2;
    const SyntheticSequence other(options);
    EXPECT_GT(
        (first.PoseAt(30).world_from_cam.params - other.PoseAt(30).world_from_cam.params).norm(),
        0.02);
    ASSERT_EQ(first.scene().quads.size(), other.scene().quads.size());
    EXPECT_EQ(first.scene().quads[9].origin, other.scene().quads[9].origin);
    // Noise of a wall that is alike in both images: none but the seed differs.
    options.image_sigma = 3.0;
    const RenderedImage exact = other.Render(0).image;
    const RenderedImage noisy = SyntheticSequence(options).Render(0).image;
    options.walk.path = 1;
    const RenderedImage first_noisy = SyntheticSequence(options).Render(0).image;
    const RenderedImage first_exact = first.Render(0).image;
    int num_different = 0;
    for (size_t i = 0; i < exact.rgb.size(); i += 3) {
      num_different += noisy.rgb[i] - exact.rgb[i] != first_noisy.rgb[i] - first_exact.rgb[i];
    }
    EXPECT_GT(num_different, static_cast<int>(exact.rgb.size() / 6));
  }
}

TEST(SyntheticSequenceTest, LoopsHaveNoLength) {
  SyntheticSequenceOptions options = Small();
  EXPECT_FALSE(SyntheticSequence(options).WalkLength().has_value());
  options.scene = SceneKind::kRooms;
  const int length = *SyntheticSequence(options).WalkLength();
  options.fps *= 0.5;
  EXPECT_NEAR(*SyntheticSequence(options).WalkLength(), 0.5 * length, 1.0);
}

TEST(SyntheticSequenceTest, RefusesReturnsWithoutLookAlikes) {
  SyntheticSequenceOptions options = Small();
  options.walk.returns = true;
  EXPECT_THROW(SyntheticSequence{options}, std::invalid_argument);
  options.scene = SceneKind::kFloors;
  EXPECT_NO_THROW(SyntheticSequence{options});
}

TEST(SyntheticSequenceTest, AccelerometerHasTheGivenNoise) {
  SyntheticSequenceOptions options = Small();
  options.accelerometer_sigma = 0.0;
  const std::vector<TimedAcceleration> exact =
      SyntheticSequence(options).AccelerometerReadings(600);
  options.accelerometer_sigma = 0.2;
  const std::vector<TimedAcceleration> noisy =
      SyntheticSequence(options).AccelerometerReadings(600);
  ASSERT_EQ(noisy.size(), exact.size());
  double squares = 0.0;
  for (size_t i = 0; i < exact.size(); ++i) {
    squares += (noisy[i].acceleration - exact[i].acceleration).squaredNorm();
  }
  EXPECT_NEAR(std::sqrt(squares / (3.0 * static_cast<double>(exact.size()))), 0.2, 0.01);
}

}  // namespace
}  // namespace msc_vo
