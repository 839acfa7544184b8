// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/tracking/plane_pose.h"

#include "msc_vo/factors/pose_prior.h"
#include "msc_vo/frame/feature_counts.h"
#include "msc_vo/matching/plane_matcher.h"
#include "msc_vo/pose_estimation/plane_factors.h"
#include "msc_vo/tracking/motion_model.h"

namespace msc_vo {

namespace {

// A hand-held camera may accelerate at any time: m/s^2, rad/s^2.
constexpr double kAccelerationSigma = 3.0, kTurnAccelerationSigma = 6.0;

// Of an image of another place, in those that a map can begin with: blank walls have some tens of
// false corners.
constexpr int kManyFeatures = 5;

// Holds the camera in place, radians and metres: a tenth of the sigmas of poses from points and
// lines, so that map planes which are not quite parallel do not move it.
constexpr double kHeldSigma = 1e-4;

PoseCovariance CovarianceOfConstantVelocity(double seconds) {
  const double squared = seconds * seconds;
  return IsotropicCovariance(kTurnAccelerationSigma * squared, kAccelerationSigma * squared);
}

std::vector<PlaneFeature> MatchedFeatures(const Frame& frame,
                                          const std::vector<PlaneMatch>& matches) {
  std::vector<PlaneFeature> matched;
  for (const PlaneMatch& match : matches) matched.push_back(frame.planes[match.feature]);
  return matched;
}

// Projection onto the motions of the camera that planes leave free: rotation vector, translation.
PoseCovariance FreeMotions(const std::vector<PlaneFeature>& planes) {
  const Eigen::Matrix3d translations = FreeTranslations(planes);
  PoseCovariance motions = PoseCovariance::Zero();
  motions.bottomRightCorner<3, 3>() = translations;
  // Parallel planes, which leave two translations free, also leave the turn about their normal.
  const bool are_parallel = translations.trace() > 1.5;
  if (are_parallel) motions.topLeftCorner<3, 3>() = Eigen::Matrix3d::Identity() - translations;
  return motions;
}

// `free`: FreeMotions().
PoseFactor PriorFactor(const PlanePosePrior& prior, const PoseCovariance& free) {
  const PoseCovariance bound = PoseCovariance::Identity() - free;
  const PoseCovariance covariance = CovarianceOfCamera(
      prior.cam_from_world, prior.covariance + bound * prior.correctable * bound);
  return {"motion", PosePrior::CreateShared(prior.cam_from_world, covariance), nullptr};
}

// By planes and other factors, without points and lines.
PoseSummary Estimate(const TrackerOptions& options, const Frame& frame,
                     const std::vector<PlaneMatch>& planes, const MapSnapshot& snapshot,
                     PlanesBeside beside, const std::vector<PoseFactor>& others,
                     Rigid3* cam_from_world) {
  std::vector<PoseFactor> factors =
      MakePlanePoseFactors(frame.planes, planes, snapshot.planes, beside);
  factors.insert(factors.end(), others.begin(), others.end());
  FrameMatches none;
  return EstimateFramePose(options.pose, frame, snapshot.map, snapshot.noise_scale, factors,
                           cam_from_world, &none);
}

}  // namespace

ExpectedPose ExpectPose(const Rigid3& last_from_world, const PoseCovariance& last_covariance,
                        double seconds, const std::optional<Rigid3>& velocity,
                        double undetermined_seconds) {
  const Rigid3 cam_from_last = velocity.value_or(Rigid3());
  ExpectedPose expected;
  expected.cam_from_world = cam_from_last * last_from_world;
  expected.covariance = ComposeCovariances(
      cam_from_last, velocity ? CovarianceOfConstantVelocity(seconds) : CovarianceOfRest(seconds),
      last_from_world, last_covariance);
  expected.free = CovarianceOfRest(undetermined_seconds);
  return expected;
}

std::optional<PlanePose> EstimateByPlanes(const TrackerOptions& options, const Frame& frame,
                                          const MapSnapshot& snapshot, const ExpectedPose& expected,
                                          const std::vector<PoseFactor>& factors) {
  PlanePose pose;
  pose.planes =
      MatchPlanes(frame.planes, snapshot.planes, expected.cam_from_world, expected.covariance);
  if (pose.planes.empty()) return std::nullopt;
  pose.is_determined = DetermineAPose(frame, pose.planes);
  const int many = kManyFeatures * options.min_initial_features;
  if (!pose.is_determined && NumWithDepth(frame) >= many) return std::nullopt;
  std::vector<PoseFactor> beside_planes = factors;
  PoseCovariance free_error = PoseCovariance::Zero();
  if (expected.free && !pose.is_determined) {
    const PlanePosePrior rest{expected.cam_from_world, IsotropicCovariance(kHeldSigma, kHeldSigma),
                              *expected.free};
    const PoseCovariance free = FreeMotions(MatchedFeatures(frame, pose.planes));
    beside_planes.push_back(PriorFactor(rest, free));
    free_error = free * rest.correctable * free;
  }
  const auto estimate = [&](PlanesBeside beside, Rigid3* cam_from_world) {
    return Estimate(options, frame, pose.planes, snapshot, beside, beside_planes, cam_from_world);
  };
  pose.cam_from_world = expected.cam_from_world;
  pose.summary = estimate(PlanesBeside::kNothing, &pose.cam_from_world);
  if (!pose.summary.usable) return std::nullopt;
  // Planes agree about a wrong calibration, but the covariance is that of the truth.
  Rigid3 near = pose.cam_from_world;
  const PoseSummary of_truth = estimate(PlanesBeside::kPointsAndLines, &near);
  if (!of_truth.usable) return std::nullopt;
  pose.summary.covariance =
      of_truth.covariance + CovarianceOfCamera(pose.cam_from_world, free_error);
  return pose;
}

bool HoldByLandmarks(const TrackerOptions& options, const Frame& frame, const MapSnapshot& snapshot,
                     const LocalMap& local, const ExpectedPose& expected,
                     const std::vector<PoseFactor>& factors, PlanePose* pose) {
  std::vector<PoseFactor> measured = MakePlanePoseFactors(
      frame.planes, pose->planes, snapshot.planes, PlanesBeside::kPointsAndLines);
  measured.insert(measured.end(), factors.begin(), factors.end());
  std::vector<PoseFactor> with_prior = measured;
  if (expected.free) {
    with_prior.push_back(
        PriorFactor({expected.cam_from_world, *expected.free}, PoseCovariance::Zero()));
  }
  const auto estimate = [&](const std::vector<PoseFactor>& of_frame, FramePose* estimated) {
    estimated->summary =
        EstimateFramePose(options.pose, frame, snapshot.map, snapshot.noise_scale, of_frame,
                          &estimated->cam_from_world, &estimated->matches);
    return estimated->summary.usable;
  };
  FramePose held{
      pose->cam_from_world, MatchLocalMap(options, frame, local, options.local_map_radius, {}), {}};
  if (!estimate(with_prior, &held)) return false;
  const int num_inliers = Sum(held.summary.num_inliers);
  if (2 * num_inliers < options.min_matches ||
      num_inliers < options.min_inlier_ratio * Sum(SizesOf(held.matches))) {
    return false;
  }
  pose->cam_from_world = held.cam_from_world;
  pose->summary = held.summary;
  pose->landmarks = LandmarkInliers(held.matches);
  FramePose without_prior{held.cam_from_world, pose->landmarks, {}};
  pose->is_determined = estimate(measured, &without_prior) &&
                        ClassifyStatus(options, without_prior.summary) == TrackingStatus::kTracked;
  return true;
}

bool CorrectByPlanes(const TrackerOptions& options, const Frame& frame,
                     const std::vector<PlaneMatch>& planes, const MapSnapshot& snapshot,
                     const PlanePosePrior& prior, FramePose* pose) {
  if (planes.empty()) return false;
  const PoseCovariance free = FreeMotions(MatchedFeatures(frame, planes));
  Rigid3 corrected = prior.cam_from_world;
  const PoseSummary summary =
      Estimate(options, frame, planes, snapshot, PlanesBeside::kPointsAndLines,
               {PriorFactor(prior, free)}, &corrected);
  if (!summary.usable) return false;
  pose->cam_from_world = corrected;
  pose->summary.covariance =
      summary.covariance + CovarianceOfCamera(corrected, free * prior.correctable * free);
  return true;
}

bool DetermineAPose(const Frame& frame, const std::vector<PlaneMatch>& matches) {
  return DetermineAPose(MatchedFeatures(frame, matches));
}

}  // namespace msc_vo
