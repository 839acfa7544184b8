// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// A frame with the status "tracked" is where its covariance says, relative to the keyframe with
// which it shares most landmarks.

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include "tests/support/random_world.h"
#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include "msc_vo/factors/rigid3_manifold.h"
#include "msc_vo/geometry/angles.h"

namespace msc_vo {
namespace {

// The error of a tracked frame relative to its reference keyframe.
struct FrameError {
  unsigned seed = 0;     // of the world
  bool is_easy = false;  // see IsEasy()
  int64_t frame = 0;
  double sigmas = 0.0;    // Mahalanobis distance / sqrt(6): its square is 1 in the mean
  double position = 0.0;  // metres
  double angle = 0.0;     // degrees
};

FrameError ErrorOf(const TrackedImage& image, const Rigid3& true_cam_from_keyframe,
                   const Keyframe& keyframe) {
  const Rigid3 expected = true_cam_from_keyframe * keyframe.cam_from_world;
  Eigen::Matrix<double, 6, 1> error;
  Rigid3Manifold().Minus(image.result.cam_from_world.params.data(), expected.params.data(),
                         error.data());
  const double mahalanobis2 = error.dot(image.result.covariance.ldlt().solve(error));
  FrameError result;
  result.frame = image.result.id;
  result.sigmas = std::sqrt(mahalanobis2 / 6.0);
  result.position =
      (image.result.cam_from_world.Inverse().translation() - expected.Inverse().translation())
          .norm();
  result.angle = RadiansToDegrees(error.head<3>().norm());
  return result;
}

// A camera with a global shutter, little noise and short intervals, as most have: nothing has to be
// learnt first.
bool IsEasy(const SyntheticSequenceOptions& options) {
  return options.readout_time == 0.0 && options.image_sigma <= 2.0 && options.fps >= 15.0;
}

std::vector<FrameError> ErrorsOfTrackedFrames(unsigned seed, int num_frames) {
  const RandomWorld world = DrawWorld(seed, num_frames);
  const SyntheticSequence sequence(world.sequence);
  std::map<double, Rigid3> true_world_from_cam;
  for (const RgbdImage& image : world.images) {
    true_world_from_cam[image.timestamp] =
        sequence.PoseAt(static_cast<int>(image.id)).world_from_cam;
  }
  std::vector<FrameError> errors;
  Odometry odometry(world.odometry, sequence.camera(), LensDistortion());
  odometry.SetTrackingObserver([&](const TrackedImage& image) {
    const Keyframe* keyframe = image.map.map.FindKeyframe(image.tracked.reference);
    if (image.result.status != TrackingStatus::kTracked || keyframe == nullptr ||
        image.result.covariance.isZero(0.0)) {
      return;
    }
    const Rigid3 cam_from_keyframe = true_world_from_cam.at(image.image.timestamp).Inverse() *
                                     true_world_from_cam.at(keyframe->frame->timestamp);
    errors.push_back(ErrorOf(image, cam_from_keyframe, *keyframe));
    errors.back().seed = seed;
    errors.back().is_easy = IsEasy(world.sequence);
  });
  for (const RgbdImage& image : world.images) odometry.Process(image);
  odometry.Finish();
  return errors;
}

double Quantile(const std::vector<FrameError>& sorted, double ratio) {
  return sorted[static_cast<size_t>(ratio * static_cast<double>(sorted.size() - 1))].sigmas;
}

void PrintQuantiles(const std::string& worlds, const std::vector<FrameError>& sorted) {
  std::cout << worlds << ": " << sorted.size()
            << " tracked frames; error in sigmas:" << std::setprecision(3);
  for (const double ratio : {0.1, 0.25, 0.5, 0.75, 0.9, 0.95, 0.99}) {
    std::cout << "  " << 100 * ratio << " %: " << Quantile(sorted, ratio);
  }
  std::cout << '\n';
}

// Counts between multiples of a quarter of a sigma; the last is that of all larger errors.
void PrintHistogram(const std::string& worlds, const std::vector<FrameError>& errors) {
  constexpr double kWidth = 0.25;
  std::array<int, 21> counts = {};
  for (const FrameError& error : errors) {
    ++counts[static_cast<size_t>(std::min(error.sigmas / kWidth, counts.size() - 1.0))];
  }
  std::cout << "histogram of " << worlds << ':';
  for (const int count : counts) std::cout << ' ' << count;
  std::cout << '\n';
}

void PrintLargeErrors(const std::vector<FrameError>& errors) {
  std::cout << "more than five sigmas: world, easy, frame, sigmas, metres, degrees\n";
  for (const FrameError& error : errors) {
    if (error.sigmas <= 5.0) continue;
    std::cout << error.seed << ' ' << error.is_easy << ' ' << error.frame << ' ' << error.sigmas
              << ' ' << error.position << ' ' << error.angle << '\n';
  }
}

// MSC_VO_RANDOM_WORLDS=400 MSC_VO_RANDOM_IMAGES=90 prints the distribution over 400 worlds of 90
// images each (docs/reliability.md).
TEST(HonestStatus, TrackedFramesAreWithinTheirSigmas) {
  const unsigned num_worlds = NumRandomWorlds(28);
  const int num_frames = NumRandomImages(30);
  std::vector<FrameError> errors;
  for (unsigned seed = 1; seed <= num_worlds; ++seed) {
    const std::vector<FrameError> of_world = ErrorsOfTrackedFrames(seed, num_frames);
    errors.insert(errors.end(), of_world.begin(), of_world.end());
  }
  ASSERT_GT(errors.size(), 100u);
  std::sort(errors.begin(), errors.end(),
            [](const FrameError& a, const FrameError& b) { return a.sigmas < b.sigmas; });
  std::vector<FrameError> easy;
  std::copy_if(errors.begin(), errors.end(), std::back_inserter(easy),
               [](const FrameError& error) { return error.is_easy; });
  ASSERT_GT(easy.size(), 50u);
  PrintQuantiles("all worlds", errors);
  PrintQuantiles("easy worlds", easy);
  PrintHistogram("all worlds", errors);
  PrintHistogram("easy worlds", easy);
  PrintLargeErrors(errors);
  // Chi-square with six degrees of freedom has a median of 5.35: 0.94 sigmas. Errors of depth
  // sensors and of rolling shutters that are not learnt yet are common to many features.
  EXPECT_GT(Quantile(errors, 0.5), 0.94 / 1.5);
  EXPECT_LT(Quantile(errors, 0.5), 0.94 * 1.5);
  EXPECT_LT(Quantile(errors, 0.9), 5.0);
  EXPECT_LT(Quantile(easy, 0.9), 3.0);
  const auto is_at_wrong_place = [](const FrameError& error) {
    return error.position > 0.5 || error.angle > 20.0;  // metres, degrees
  };
  const auto num_wrong = std::count_if(errors.begin(), errors.end(), is_at_wrong_place);
  std::cout << num_wrong << " frames at a wrong place\n";
  // None in the usual worlds; over 240 worlds it was 1 in 9000 (docs/reliability.md).
  EXPECT_LE(static_cast<size_t>(num_wrong), errors.size() / 5000);
}

}  // namespace
}  // namespace msc_vo
