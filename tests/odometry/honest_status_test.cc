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
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "tests/support/random_world.h"
#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include "msc_vo/factors/rigid3_manifold.h"
#include "msc_vo/geometry/angles.h"
#include "msc_vo/map/observer_count.h"

namespace msc_vo {
namespace {

// The error of a tracked frame relative to its reference keyframe.
struct FrameError {
  unsigned seed = 0;     // of the world
  bool is_easy = false;  // see IsEasy()
  int64_t frame = 0;
  double sigmas = 0.0;      // Mahalanobis distance / sqrt(6): its square is 1 in the mean
  double position = 0.0;    // metres
  double angle = 0.0;       // degrees
  std::string explanation;  // if more than kMaxSigmas
};

FrameError ErrorOf(const TrackedImage& image, const Rigid3& true_cam_from_world) {
  Eigen::Matrix<double, 6, 1> error;
  Rigid3Manifold().Minus(image.result.cam_from_world.params.data(),
                         true_cam_from_world.params.data(), error.data());
  const double mahalanobis2 = error.dot(image.result.covariance->ldlt().solve(error));
  FrameError result;
  result.frame = image.result.id;
  result.sigmas = std::sqrt(mahalanobis2 / 6.0);
  result.position = (image.result.cam_from_world.Inverse().translation() -
                     true_cam_from_world.Inverse().translation())
                        .norm();
  result.angle = RadiansToDegrees(error.head<3>().norm());
  return result;
}

// True poses by time stamp.
using PosesByTime = std::map<double, Rigid3>;

// The true pose of the frame relative to `keyframe`, whose pose in the map is taken for true.
Rigid3 TruePose(const PosesByTime& world_from_cam, const TrackedImage& image,
                const Keyframe& keyframe) {
  const Rigid3 cam_from_keyframe = world_from_cam.at(image.image.timestamp).Inverse() *
                                   world_from_cam.at(keyframe.frame->timestamp);
  return cam_from_keyframe * keyframe.cam_from_world;
}

bool IsAtWrongPlace(const FrameError& error) {
  return error.position > 0.5 || error.angle > 20.0;  // metres, degrees
}

// Fraction of the inliers of a frame that are off by more than three pixels at its true pose.
double FractionOfWrongInliers(const TrackedImage& image, const Rigid3& true_cam_from_world) {
  constexpr double kMaxDistance = 3.0;
  const Frame& frame = *image.tracked.frame;
  const auto project = [&](const Eigen::Vector3d& x) {
    return frame.camera.Project(true_cam_from_world * x);
  };
  int num_matches = 0;
  int num_wrong = 0;
  for (const PointMatch& match : image.tracked.matches.points) {
    const PointLandmark* landmark = image.map.map.Find<PointLandmark>(match.id);
    if (landmark == nullptr) continue;
    const Eigen::Vector2d offset = frame.points[match.feature].pixel - project(landmark->position);
    num_wrong += !(offset.norm() <= kMaxDistance);
    ++num_matches;
  }
  for (const LineMatch& match : image.tracked.matches.lines) {
    const LineLandmark* landmark = image.map.map.Find<LineLandmark>(match.id);
    if (landmark == nullptr) continue;
    const LineSegment2& segment = frame.lines[match.feature].segment;
    const LineSegment2 truth{project(landmark->segment.start), project(landmark->segment.end)};
    num_wrong += std::max(truth.DistanceToLine(segment.start), truth.DistanceToLine(segment.end)) >
                 kMaxDistance;
    ++num_matches;
  }
  return static_cast<double>(num_wrong) / std::max(1, num_matches);
}

// Least error, in sigmas, relative to a keyframe with at least a quarter as many common landmarks
// as the one with most of them.
double LeastError(const PosesByTime& world_from_cam, const TrackedImage& image) {
  const Map& map = image.map.map;
  ObserverCount observers(map);
  for (const PointMatch& match : image.tracked.matches.points) {
    if (const PointLandmark* landmark = map.Find<PointLandmark>(match.id)) observers.Add(*landmark);
  }
  for (const LineMatch& match : image.tracked.matches.lines) {
    if (const LineLandmark* landmark = map.Find<LineLandmark>(match.id)) observers.Add(*landmark);
  }
  const std::vector<Map::Covisible> ranked = observers.Ranked();
  double least = std::numeric_limits<double>::infinity();
  for (const Map::Covisible& other : ranked) {
    if (4 * other.num_shared < ranked.front().num_shared) break;
    const Rigid3 truth = TruePose(world_from_cam, image, *map.FindKeyframe(other.keyframe));
    least = std::min(least, ErrorOf(image, truth).sigmas);
  }
  return least;
}

// Returns the first explanation that applies. To be read, not tested.
std::string Explain(const SyntheticSequenceOptions& world, const PosesByTime& world_from_cam,
                    const TrackedImage& image, const Rigid3& true_cam_from_world,
                    const FrameError& error) {
  const FrameMatches& matches = image.tracked.matches;
  if (IsAtWrongPlace(error)) return "wrong place";
  if (FractionOfWrongInliers(image, true_cam_from_world) >= 0.25) return "wrong inliers";
  if (LeastError(world_from_cam, image) <= 3.0) return "reference keyframe";
  if (matches.points.size() + matches.lines.size() <= 25) return "few matches";
  if (world.readout_time > 0.0 && world.fps <= 5.0) return "rolling shutter";
  return "none";
}

// Errors above this are explained one by one.
constexpr double kMaxSigmas = 5.0;

// A camera with a global shutter, little noise and short intervals, as most have: nothing has to be
// learnt first.
bool IsEasy(const SyntheticSequenceOptions& options) {
  return options.readout_time == 0.0 && options.image_sigma <= 2.0 && options.fps >= 15.0;
}

std::vector<FrameError> ErrorsOfTrackedFrames(unsigned seed, int num_frames) {
  const RandomWorld world = DrawWorld(seed, num_frames);
  const SyntheticSequence sequence(world.sequence);
  PosesByTime world_from_cam;
  for (const RgbdImage& image : world.images) {
    world_from_cam[image.timestamp] = sequence.PoseAt(static_cast<int>(image.id)).world_from_cam;
  }
  std::vector<FrameError> errors;
  Odometry odometry(world.odometry, sequence.camera(), LensDistortion());
  odometry.SetTrackingObserver([&](const TrackedImage& image) {
    const Keyframe* keyframe = image.map.map.FindKeyframe(image.tracked.reference);
    if (image.result.status != TrackingStatus::kTracked || keyframe == nullptr ||
        !image.result.covariance) {
      return;
    }
    const Rigid3 truth = TruePose(world_from_cam, image, *keyframe);
    FrameError error = ErrorOf(image, truth);
    error.seed = seed;
    error.is_easy = IsEasy(world.sequence);
    if (error.sigmas > kMaxSigmas) {
      error.explanation = Explain(world.sequence, world_from_cam, image, truth, error);
    }
    errors.push_back(error);
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
  std::map<std::string, int> explanations;
  std::cout << "more than five sigmas: world, easy, frame, sigmas, metres, degrees, explanation\n";
  for (const FrameError& error : errors) {
    if (error.sigmas <= kMaxSigmas) continue;
    std::cout << error.seed << ' ' << error.is_easy << ' ' << error.frame << ' ' << error.sigmas
              << ' ' << error.position << ' ' << error.angle << ' ' << error.explanation << '\n';
    ++explanations[error.explanation];
  }
  for (const auto& [explanation, count] : explanations) {
    std::cout << "explained by " << explanation << ": " << count << '\n';
  }
}

// MSC_VO_RANDOM_WORLDS=400 MSC_VO_RANDOM_IMAGES=90 prints the distribution over 400 worlds of 90
// images each (docs/reliability.md).
TEST(HonestStatus, TrackedFramesAreWithinTheirSigmas) {
  const unsigned first = FirstRandomWorld();
  const unsigned end = first + NumRandomWorlds(28);
  const int num_frames = NumRandomImages(30);
  std::vector<FrameError> errors;
  for (unsigned seed = first; seed < end; ++seed) {
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
  const auto num_wrong = std::count_if(errors.begin(), errors.end(), IsAtWrongPlace);
  std::cout << num_wrong << " frames at a wrong place\n";
  // None in the usual worlds; docs/reliability.md has the ratio over 240 worlds.
  EXPECT_LE(static_cast<size_t>(num_wrong), errors.size() / 5000);
}

}  // namespace
}  // namespace msc_vo
