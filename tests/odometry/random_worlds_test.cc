// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// What holds in every run, on worlds, cameras and faults that are drawn at random. A failure prints
// the seed of its world.

#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include "tests/support/rendered_images.h"
#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "msc_vo/map/map_validation.h"

namespace msc_vo {
namespace {

constexpr int kNumFrames = 30;

struct World {
  SyntheticSequenceOptions sequence;
  OdometryOptions odometry;
  std::vector<RgbdImage> images;
};

template <typename T, size_t N>
T Choose(const T (&values)[N], std::mt19937* random) {
  return values[(*random)() % N];
}

// One image in ten has a fault.
void Disturb(std::mt19937* random, RgbdImage* image) {
  switch ((*random)() % 30) {
    case 0:
      return Cover(image);
    case 1:
      image->depth = cv::Mat(image->depth.rows, image->depth.cols, CV_32FC1, cv::Scalar(0));
      return;
    case 2:  // noise
      image->gray = image->gray.clone();
      for (int y = 0; y < image->gray.rows; ++y) {
        uint8_t* row = image->gray.ptr<uint8_t>(y);
        for (int x = 0; x < image->gray.cols; ++x) row[x] = static_cast<uint8_t>((*random)() >> 24);
      }
      return;
    default:
      return;
  }
}

World DrawWorld(unsigned seed) {
  std::mt19937 random(seed);
  World world;
  SyntheticSequenceOptions& sequence = world.sequence;
  sequence.scene = Choose({SceneKind::kRoom, SceneKind::kCorridor, SceneKind::kBare,
                           SceneKind::kSlanted, SceneKind::kHouse, SceneKind::kBox},
                          &random);
  sequence.seed = random() % 1000;
  sequence.width = Choose({160, 240, 320}, &random);
  sequence.height = sequence.width * 3 / 4;
  sequence.fps = Choose({2.0, 5.0, 15.0, 30.0}, &random);
  sequence.depth = Choose({SyntheticDepth::kExact, SyntheticDepth::kKinect,
                           SyntheticDepth::kTimeOfFlight, SyntheticDepth::kStereo},
                          &random);
  sequence.readout_time = Choose({0.0, 0.02}, &random);
  sequence.image_sigma = Choose({0.0, 2.0, 6.0}, &random);
  sequence.path.shake = Choose({0.0, 1.0, 3.0}, &random);
  world.odometry.use_points = random() % 5 != 0;
  world.odometry.use_lines = !world.odometry.use_points || random() % 5 != 0;
  world.images = RenderImages(sequence, kNumFrames);
  for (RgbdImage& image : world.images) Disturb(&random, &image);
  return world;
}

void ExpectPoseWithCovariance(const FrameResult& frame) {
  EXPECT_TRUE(frame.cam_from_world.params.allFinite());
  EXPECT_NEAR(frame.cam_from_world.rotation().norm(), 1.0, 1e-9);
  if (frame.covariance.isZero(0.0)) return;
  EXPECT_TRUE(frame.covariance.isApprox(frame.covariance.transpose(), 1e-9));
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> eigen(frame.covariance);
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

OdometryResult Replay(const World& world, int num_threads, bool checks) {
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
  const World world = DrawWorld(GetParam());
  const OdometryResult checked = Replay(world, 1, true);
  EXPECT_EQ(checked.frames.size(), static_cast<size_t>(kNumFrames));
  ExpectSameBytes(checked, Replay(world, 2, false));
}

// MSC_VO_RANDOM_WORLDS=500 in the environment: a long run.
unsigned NumWorlds() {
  const char* number = std::getenv("MSC_VO_RANDOM_WORLDS");
  return number == nullptr ? 12 : static_cast<unsigned>(std::atoi(number));
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomWorldTest, ::testing::Range(1u, NumWorlds() + 1));

}  // namespace
}  // namespace msc_vo
