// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// What holds in every run, on worlds, cameras and faults that are drawn at random. A failure prints
// the seed of its world.

#include <string>

#include "tests/support/random_world.h"
#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "msc_vo/map/map_validation.h"

namespace msc_vo {
namespace {

constexpr int kNumFrames = 30;

void ExpectPoseWithCovariance(const FrameResult& frame) {
  EXPECT_TRUE(frame.cam_from_world.params.allFinite());
  EXPECT_NEAR(frame.cam_from_world.rotation().norm(), 1.0, 1e-9);
  if (!frame.covariance) return;
  EXPECT_TRUE(frame.covariance->isApprox(frame.covariance->transpose(), 1e-9));
  const Eigen::SelfAdjointEigenSolver<PoseCovariance> eigen(*frame.covariance);
  EXPECT_GT(eigen.eigenvalues().minCoeff(), 0.0);
}

void ExpectDescent(const BundleAdjustmentOptions& options, WindowData window) {
  // With the noise of the landmarks held, the cost of both solves is that of the same sum.
  BundleAdjustmentOptions same_noise = options;
  same_noise.landmark_noise.enabled = false;
  const BundleAdjustmentSummary summary = LocalBundleAdjustment(same_noise, &window);
  EXPECT_TRUE(summary.usable) << summary.message;
  EXPECT_LE(summary.final_cost, summary.initial_cost * (1.0 + 1e-12));
}

OdometryResult Replay(const RandomWorld& world, int num_threads, bool checks) {
  OdometryOptions options = world.odometry;
  options.threads = num_threads;
  Odometry odometry(options, SyntheticSequence(world.sequence).camera(), LensDistortion());
  if (checks) {
    odometry.SetTrackingObserver([](const TrackedImage& image) {
      EXPECT_EQ(FirstViolation(image.map.map), "") << "image " << image.image.id;
      ExpectPoseWithCovariance(image.result);
    });
    odometry.SetWindowObserver(
        [](KeyframeId, const BundleAdjustmentOptions& window_options, const WindowData& window) {
          ExpectDescent(window_options, window);
        });
  }
  for (const RgbdImage& image : world.images) odometry.Process(image);
  return odometry.Finish();
}

class RandomWorldTest : public ::testing::TestWithParam<unsigned> {};

TEST_P(RandomWorldTest, SatisfiesInvariants) {
  SCOPED_TRACE("seed " + std::to_string(GetParam()));
  const RandomWorld world = DrawWorld(GetParam(), kNumFrames);
  const OdometryResult checked = Replay(world, 1, true);
  EXPECT_EQ(checked.frames.size(), static_cast<size_t>(kNumFrames));
  ExpectSameBytes(checked, Replay(world, 2, false));
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomWorldTest,
                         ::testing::Range(FirstRandomWorld(),
                                          FirstRandomWorld() + NumRandomWorlds(12)));

}  // namespace
}  // namespace msc_vo
