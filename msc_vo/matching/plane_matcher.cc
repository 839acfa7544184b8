// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/matching/plane_matcher.h"

#include <algorithm>
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

// Three sigmas of a feature, squared, 1/metres^2.
double SquaredThreeSigmas(const PlaneFeature& feature, double noise) {
  const double variance =
      noise * noise * feature.mean_square_ray.cwiseProduct(feature.covariance).sum();
  return kMaxSigmas * kMaxSigmas * variance;
}

bool AreParallel(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  static const double min_cosine = std::cos(DegreesToRadians(kMaxAngle));
  return a.dot(b) >= min_cosine;
}

Eigen::Vector3d InverseDepth(const Plane& in_cam) { return -in_cam.normal() / in_cam.offset(); }

// Mean squared difference of inverse depths where a feature was seen, 1/metres^2.
double SquaredDifference(const PlaneFeature& feature, const Eigen::Vector3d& a,
                         const Eigen::Vector3d& b) {
  return (a - b).dot(feature.mean_square_ray * (a - b));
}

}  // namespace

std::vector<PlaneMatch> MatchPlanes(const std::vector<PlaneFeature>& features, const MapPlanes& map,
                                    const Rigid3& cam_from_world) {
  std::vector<PlaneMatch> matches;
  const Rigid3 world_from_cam = cam_from_world.Inverse();
  for (size_t i = 0; i < features.size(); ++i) {
    const PlaneFeature& feature = features[i];
    const PlaneExtent extent = world_from_cam * feature.Extent();
    PlaneMatch match{static_cast<int>(i), kNoId};
    const double limit =
        SquaredThreeSigmas(feature, map.noise) + kPredictionError * kPredictionError;
    double least = limit;
    bool is_seen = false;
    for (const PlaneLandmark& landmark : map.planes) {
      const Plane in_cam = cam_from_world * landmark.plane;
      if (in_cam.offset() < kMinDistance || !AreParallel(in_cam.normal(), feature.Normal())) {
        continue;
      }
      const double squared =
          SquaredDifference(feature, InverseDepth(in_cam), feature.inverse_depth);
      if (squared >= limit || (is_seen && squared >= least)) continue;
      const bool touches = AreTouching(landmark.plane, landmark.extent, extent, 0.0);
      if (touches == is_seen ? squared >= least : is_seen) continue;
      least = squared;
      is_seen = touches;
      match.plane = landmark.id;
    }
    if (match.plane != kNoId) matches.push_back(match);
  }
  return matches;
}

bool AreSamePlane(const PlaneFeature& feature, const PlaneLandmark& a, const PlaneLandmark& b,
                  double noise) {
  const double limit = SquaredThreeSigmas(feature, noise);
  if (a.plane.offset() < kMinDistance || b.plane.offset() < kMinDistance ||
      !AreParallel(a.plane.normal(), b.plane.normal()) ||
      SquaredDifference(feature, InverseDepth(a.plane), InverseDepth(b.plane)) >= limit) {
    return false;
  }
  // An error e of inverse depth is one of z^2 e of depth.
  const auto is_near = [limit](const Plane& plane, const PlaneExtent& extent) {
    return std::all_of(extent.begin(), extent.end(), [&](const Eigen::Vector3d& vertex) {
      const double distance = plane.normal().dot(vertex) + plane.offset();
      return distance * distance < limit * std::pow(vertex.squaredNorm(), 2);
    });
  };
  return is_near(a.plane, b.extent) && is_near(b.plane, a.extent);
}

bool DetermineAPose(const std::vector<PlaneFeature>& features) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const PlaneFeature& feature : features)
    sum += feature.Normal() * feature.Normal().transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(sum, Eigen::EigenvaluesOnly);
  return eigen.eigenvalues()[0] >= kMinSpan;
}

}  // namespace msc_vo
