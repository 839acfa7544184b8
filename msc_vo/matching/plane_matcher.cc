// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/matching/plane_matcher.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "msc_vo/factors/chi_square.h"
#include "msc_vo/geometry/so3.h"

namespace msc_vo {

namespace {

// Largest error of inverse depth that the pose may add, 1/metres: 8 cm at 2 m. A wider search finds
// other surfaces of a room.
constexpr double kMaxPoseSigma = 0.02;
// Twice the log of the odds against the next plane.
const double kMinLogOdds = std::getenv("PLO") ? std::atof(std::getenv("PLO")) : 0.0;
// Nearest plane, metres: the inverse depths of nearer ones are not defined.
constexpr double kMinDistance = 0.05;
// Smallest eigenvalue of the sum of n n^T of normals that span space: that of three planes of which
// one is tilted by 15 degrees out of the direction that the others leave free.
constexpr double kMinSpan = 0.067;

// Change of the inverse depths of a plane (camera) with the pose, tangent of Rigid3Manifold.
Eigen::Matrix<double, 3, 6> JacobianOfPose(const Plane& in_cam, const Eigen::Vector3d& translation) {
  const Eigen::Vector3d n = in_cam.normal();
  const double d = in_cam.offset();
  Eigen::Matrix<double, 3, 6> jacobian;
  jacobian.leftCols<3>() =
      Skew(n) / d + n * (translation.transpose() * Skew(n)) / (d * d);
  jacobian.rightCols<3>() = -n * n.transpose() / (d * d);
  return jacobian;
}

}  // namespace

std::vector<PlaneMatch> MatchPlanes(const std::vector<PlaneFeature>& features, const MapPlanes& map,
                                    const Rigid3& cam_from_world,
                                    const PoseCovariance& covariance) {
  std::vector<PlaneMatch> matches;
  for (size_t i = 0; i < features.size(); ++i) {
    const PlaneFeature& feature = features[i];
    if (std::getenv("PLDUMP") && i == 0) std::fprintf(stderr, "MATCH %zu features %zu planes\n", features.size(), map.planes.size());
    // The plane of the map is as uncertain as one observation.
    const Eigen::Matrix3d of_planes = 2.0 * map.noise * map.noise * feature.covariance;
    PlaneMatch match{static_cast<int>(i), kNoId};
    double least = std::numeric_limits<double>::infinity(), second = least;
    for (const PlaneLandmark& landmark : map.planes) {
      const Plane in_cam = cam_from_world * landmark.plane;
      if (in_cam.offset() < kMinDistance || in_cam.normal().dot(feature.Normal()) <= 0.0) continue;
      const Eigen::Vector3d difference = -in_cam.normal() / in_cam.offset() - feature.inverse_depth;
      const auto jacobian = JacobianOfPose(in_cam, cam_from_world.translation());
      const Eigen::Matrix3d of_pose = jacobian * covariance * jacobian.transpose();
      if (feature.mean_square_ray.cwiseProduct(of_pose).sum() > kMaxPoseSigma * kMaxPoseSigma) {
        continue;
      }
      const Eigen::Matrix3d sum = of_planes + of_pose;
      const Eigen::LLT<Eigen::Matrix3d> factor(sum);
      const double squared = difference.dot(factor.solve(difference));
      const double unlikelihood = squared + 2.0 * factor.matrixLLT().diagonal().array().log().sum();
      if (std::getenv("PLDUMP")) std::fprintf(stderr, "cand f%zu n%d l%ld chi2 %.2f d %.3f of_pose %.5f noise %.2f q %.4f %.4f %.4f diff %.5f %.5f %.5f\n", i, feature.num_pixels, long(landmark.id), squared, in_cam.offset(), std::sqrt(feature.mean_square_ray.cwiseProduct(of_pose).sum()), map.noise, feature.inverse_depth.x(), feature.inverse_depth.y(), feature.inverse_depth.z(), difference.x(), difference.y(), difference.z());
      if (squared > kOutlierChiSquare[3]) continue;
      if (unlikelihood >= least) {
        second = std::min(second, unlikelihood);
        continue;
      }
      second = std::exchange(least, unlikelihood);
      match.plane = landmark.id;
    }
    if (match.plane != kNoId && second - least >= kMinLogOdds) matches.push_back(match);
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
