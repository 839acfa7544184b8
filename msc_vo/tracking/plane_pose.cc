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

PoseCovariance CovarianceOfConstantVelocity(double seconds) {
  const double squared = seconds * seconds;
  return IsotropicCovariance(kTurnAccelerationSigma * squared, kAccelerationSigma * squared);
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
  const PoseCovariance of_prior =
      CovarianceOfCamera(expected.cam_from_world, CovarianceOfRest(undetermined_seconds));
  expected.prior =
      PoseFactor{"motion", PosePrior::CreateShared(expected.cam_from_world, of_prior), nullptr};
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
  const auto estimate = [&](PlanesBeside beside, Rigid3* cam_from_world) {
    std::vector<PoseFactor> all =
        MakePlanePoseFactors(frame.planes, pose.planes, snapshot.planes, beside);
    all.insert(all.end(), factors.begin(), factors.end());
    if (expected.prior && !pose.is_determined) all.push_back(*expected.prior);
    FrameMatches none;
    return EstimateFramePose(options.pose, frame, snapshot.map, snapshot.noise_scale, all,
                             cam_from_world, &none);
  };
  pose.cam_from_world = expected.cam_from_world;
  pose.summary = estimate(PlanesBeside::kNothing, &pose.cam_from_world);
  if (!pose.summary.usable) return std::nullopt;
  // Planes agree about a wrong calibration, but the covariance is that of the truth.
  Rigid3 near = pose.cam_from_world;
  const PoseSummary of_truth = estimate(PlanesBeside::kPointsAndLines, &near);
  if (!of_truth.usable) return std::nullopt;
  pose.summary.covariance = of_truth.covariance;
  return pose;
}

bool DetermineAPose(const Frame& frame, const std::vector<PlaneMatch>& matches) {
  std::vector<PlaneFeature> matched;
  for (const PlaneMatch& match : matches) matched.push_back(frame.planes[match.feature]);
  return DetermineAPose(matched);
}

}  // namespace msc_vo
