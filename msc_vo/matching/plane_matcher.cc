// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/matching/plane_matcher.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "msc_vo/factors/chi_square.h"
#include "msc_vo/geometry/angles.h"
#include "msc_vo/geometry/so3.h"

namespace msc_vo {

namespace {

// Largest error that the pose may add, in parts of the distance of the plane: 10 cm at 2 m. A wider
// search finds other surfaces of a room.
constexpr double kMaxPoseError = 0.05;
// A pose by few points states a third of its error (90 % quantile in hard scenes), or less.
constexpr double kUnstatedError = 3.0;
constexpr double kLeastRotationError = 0.3, kLeastTranslationError = 0.003;  // degrees, metres
constexpr double kMaxSigmas = 3.0;
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

// Change of the inverse depths of a plane (camera) with the pose, tangent of Rigid3Manifold.
Eigen::Matrix<double, 3, 6> JacobianOfPose(const Plane& in_cam,
                                           const Eigen::Vector3d& translation) {
  const Eigen::Vector3d n = in_cam.normal();
  const double d = in_cam.offset();
  Eigen::Matrix<double, 3, 6> jacobian;
  jacobian.leftCols<3>() = Skew(n) / d + n * (translation.transpose() * Skew(n)) / (d * d);
  jacobian.rightCols<3>() = -n * n.transpose() / (d * d);
  return jacobian;
}

// -2 log likelihood, without its constant, of a feature as a plane (camera); infinite if they
// contradict each other, or if the pose is too uncertain to tell. The plane is taken to be as
// uncertain as one observation.
double Unlikelihood(const PlaneFeature& feature, const Plane& in_cam, double noise,
                    const Rigid3& cam_from_world, const PoseCovariance& covariance) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  if (in_cam.offset() < kMinDistance || in_cam.normal().dot(feature.Normal()) <= 0.0) return kNever;
  const auto jacobian = JacobianOfPose(in_cam, cam_from_world.translation());
  const Eigen::Matrix3d of_pose = jacobian * covariance * jacobian.transpose();
  const double max_sigma = kMaxPoseError / in_cam.offset();
  if (feature.mean_square_ray.cwiseProduct(of_pose).sum() > max_sigma * max_sigma) return kNever;
  const Eigen::LLT<Eigen::Matrix3d> sum(of_pose + 2.0 * noise * noise * feature.covariance);
  const Eigen::Vector3d difference = InverseDepth(in_cam) - feature.inverse_depth;
  const double squared = difference.dot(sum.solve(difference));
  if (!(squared <= kOutlierChiSquare[3])) return kNever;
  return squared + 2.0 * sum.matrixLLT().diagonal().array().log().sum();
}

}  // namespace

std::vector<PlaneMatch> MatchPlanes(const std::vector<PlaneFeature>& features, const MapPlanes& map,
                                    const Rigid3& cam_from_world,
                                    const PoseCovariance& covariance) {
  std::vector<PlaneMatch> matches;
  const Rigid3 world_from_cam = cam_from_world.Inverse();
  for (size_t i = 0; i < features.size(); ++i) {
    const PlaneFeature& feature = features[i];
    const PlaneExtent extent = world_from_cam * feature.Extent();
    PlaneMatch match{static_cast<int>(i), kNoId};
    double least = std::numeric_limits<double>::infinity();
    bool is_seen = false;
    for (const PlaneLandmark& landmark : map.planes) {
      const double unlikelihood = Unlikelihood(feature, cam_from_world * landmark.plane, map.noise,
                                               cam_from_world, covariance);
      if (!std::isfinite(unlikelihood) || (is_seen && unlikelihood >= least)) continue;
      const bool touches = AreTouching(landmark.plane, landmark.extent, extent, 0.0);
      if (touches == is_seen ? unlikelihood >= least : is_seen) continue;
      least = unlikelihood;
      is_seen = touches;
      match.plane = landmark.id;
    }
    if (match.plane != kNoId) matches.push_back(match);
  }
  return matches;
}

PoseCovariance CovarianceForMatching(const Rigid3& cam_from_world, const PoseCovariance& stated) {
  const PoseCovariance least =
      IsotropicCovariance(DegreesToRadians(kLeastRotationError), kLeastTranslationError);
  return kUnstatedError * kUnstatedError * stated + CovarianceOfCamera(cam_from_world, least);
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

Eigen::Matrix3d FreeTranslations(const std::vector<PlaneFeature>& features) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const PlaneFeature& feature : features)
    sum += feature.Normal() * feature.Normal().transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(sum);
  Eigen::Matrix3d projection = Eigen::Matrix3d::Zero();
  for (int i = 0; i < 3 && eigen.eigenvalues()[i] < kMinSpan; ++i) {
    projection += eigen.eigenvectors().col(i) * eigen.eigenvectors().col(i).transpose();
  }
  return projection;
}

}  // namespace msc_vo
