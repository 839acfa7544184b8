// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/matching/plane_matcher.h"

#include <cmath>

#include <Eigen/Eigenvalues>

#include "msc_vo/geometry/angles.h"

namespace msc_vo {

namespace {

// A match differs in inverse depth by three sigmas of the feature, and by what the error of a
// predicted pose adds, 1/metres: 4 mm at 1 m.
constexpr double kMaxSigmas = 3.0;
constexpr double kPredictionError = 0.004;
constexpr double kMaxAngle = 8.0;  // degrees
// Nearest plane, metres: the inverse depths of nearer ones are not defined.
constexpr double kMinDistance = 0.05;
// Smallest eigenvalue of the sum of n n^T of normals that span space: that of three planes of which
// one is tilted by 15 degrees out of the direction that the others leave free.
constexpr double kMinSpan = 0.067;

// Of a match, 1/metres^2.
double MaxSquaredDifference(const PlaneFeature& feature, double noise) {
  const double variance =
      noise * noise * feature.mean_square_ray.cwiseProduct(feature.covariance).sum();
  return kMaxSigmas * kMaxSigmas * variance + kPredictionError * kPredictionError;
}

}  // namespace

std::vector<PlaneMatch> MatchPlanes(const std::vector<PlaneFeature>& features, const MapPlanes& map,
                                    const Rigid3& cam_from_world) {
  std::vector<PlaneMatch> matches;
  const double min_cosine = std::cos(DegreesToRadians(kMaxAngle));
  for (size_t i = 0; i < features.size(); ++i) {
    const PlaneFeature& feature = features[i];
    PlaneMatch match{static_cast<int>(i), kNoId};
    double least = MaxSquaredDifference(feature, map.noise);
    for (const PlaneLandmark& landmark : map.planes) {
      const Plane in_cam = cam_from_world * landmark.plane;
      if (in_cam.offset() < kMinDistance || in_cam.normal().dot(feature.Normal()) < min_cosine) {
        continue;
      }
      const Eigen::Vector3d difference = -in_cam.normal() / in_cam.offset() - feature.inverse_depth;
      const double squared = difference.dot(feature.mean_square_ray * difference);
      if (squared >= least) continue;
      least = squared;
      match.plane = landmark.id;
    }
    if (match.plane != kNoId) matches.push_back(match);
  }
  return matches;
}

bool DetermineAPose(const std::vector<PlaneFeature>& features) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const PlaneFeature& feature : features)
    sum += feature.Normal() * feature.Normal().transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(sum, Eigen::EigenvaluesOnly);
  return eigen.eigenvalues()[0] >= kMinSpan;
}

}  // namespace msc_vo
