// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/diagnosis/pair_calibration.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "msc_vo/diagnosis/quantile.h"
#include "msc_vo/geometry/so3.h"

namespace msc_vo {

namespace {

constexpr size_t kMinPairs = 8;
constexpr int kIterations = 12;
constexpr int kGroups = 8;
// Rolling shutters and delays are not known: the time of a pixel is uncertain by this, seconds.
constexpr double kTimeSigma = 0.008;
constexpr double kMinScale = 0.7;  // of the errors, in sigmas of the features

// Corrections of the calibration: logarithm of the focal length, shift of the principal point in
// focal lengths, and k1.
using Vector4 = Eigen::Vector4d;
using Vector6 = Eigen::Matrix<double, 6, 1>;
// Standard deviations of the corrections before any image is seen.
const Vector4 kPrior(0.3, 0.2, 0.2, 0.3);

Eigen::Vector3d CorrectedRay(const PinholeCamera& camera, const Eigen::Vector2d& pixel,
                             const Vector4& correction) {
  const Eigen::Vector3d ray = camera.Ray(pixel);
  const double scale = std::exp(-correction(0));
  const double x = scale * (ray.x() - correction(1));
  const double y = scale * (ray.y() - correction(2));
  // The first-order inverse of the distortion 1 + k1 r^2.
  const double radial = 1.0 - correction(3) * (x * x + y * y);
  return {radial * x, radial * y, 1.0};
}

// Errors in sigmas: reprojection along x and y, and inverse depth in the second image. `time_sigma`,
// pixels, is the error by rolling shutter and delays.
Eigen::Vector3d Errors(const PinholeCamera& camera, const PointPair& pair, const Rigid3& motion,
                       const Vector4& correction, double time_sigma) {
  const Eigen::Vector3d from = CorrectedRay(camera, pair.from.pixel, correction);
  const Eigen::Vector3d to = CorrectedRay(camera, pair.to.pixel, correction);
  const double inverse_depth = pair.from.inverse_depth;
  const Eigen::Vector3d moved = motion.rotation() * from + inverse_depth * motion.translation();
  const double focal_length = camera.FocalLength() * std::exp(correction(0));
  const double parallax = focal_length * motion.translation().norm();
  const double sigma = std::sqrt(pair.from.sigma * pair.from.sigma +
                                 pair.to.sigma * pair.to.sigma + time_sigma * time_sigma +
                                 std::pow(parallax * pair.from.inverse_depth_sigma, 2));
  Eigen::Vector3d errors;
  errors.head<2>() = focal_length / sigma * (moved.head<2>() / moved.z() - to.head<2>());
  errors.z() = 0.0;
  if (pair.to.HasDepth()) {
    const double depth_sigma = std::hypot(pair.from.inverse_depth_sigma,
                                          pair.to.inverse_depth_sigma);
    errors.z() = (inverse_depth / moved.z() - pair.to.inverse_depth) / depth_sigma;
  }
  return errors;
}

Rigid3 Perturbed(const Rigid3& motion, const Vector6& step) {
  return Rigid3(ExpSO3(step.head<3>()), step.tail<3>()) * motion;
}

// Normal equations of one pair after its pose has been eliminated, and what recovers its pose step.
struct ReducedPair {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Zero();
  Vector4 gradient = Vector4::Zero();
  Eigen::Matrix<double, 6, 4> pose_from_correction;
  Vector6 pose_step;
};

class PairProblem {
 public:
  PairProblem(const PinholeCamera& camera, const MotionTrack& track, const MotionPair& pair)
      : camera_(camera),
        pair_(pair),
        motion_(pair.motion.to_from_from),
        time_sigma_(kTimeSigma * std::hypot(track.images[pair.from].velocity.norm(),
                                            track.images[pair.to].velocity.norm())) {}

  ReducedPair Linearize(const Vector4& correction) const {
    const double scale = std::max(kMinScale, MedianError(correction));
    Eigen::Matrix<double, 10, 10> matrix = 1e-6 * Eigen::Matrix<double, 10, 10>::Identity();
    Eigen::Matrix<double, 10, 1> gradient = Eigen::Matrix<double, 10, 1>::Zero();
    for (const PointPair& point : pair_.motion.points) {
      const Eigen::Vector3d errors = ErrorsOf(point, motion_, correction);
      const Eigen::Matrix<double, 3, 10> jacobian = Jacobian(point, correction);
      // Cauchy weights, one for the pixel and one for the depth.
      const double limit = 4.0 * scale * scale;
      const double pixel = 1.0 / (1.0 + errors.head<2>().squaredNorm() / limit);
      const double depth = 1.0 / (1.0 + errors.z() * errors.z() / limit);
      const Eigen::Vector3d weights = Eigen::Vector3d(pixel, pixel, depth) / (scale * scale);
      matrix += jacobian.transpose() * weights.asDiagonal() * jacobian;
      gradient += jacobian.transpose() * weights.cwiseProduct(errors);
    }
    ReducedPair reduced;
    const Eigen::LDLT<Eigen::Matrix<double, 6, 6>> pose(matrix.topLeftCorner<6, 6>());
    reduced.pose_from_correction = -pose.solve(matrix.topRightCorner<6, 4>());
    reduced.pose_step = -pose.solve(gradient.head<6>());
    reduced.matrix = matrix.bottomRightCorner<4, 4>() +
                     matrix.bottomLeftCorner<4, 6>() * reduced.pose_from_correction;
    reduced.gradient =
        gradient.tail<4>() + matrix.bottomLeftCorner<4, 6>() * reduced.pose_step;
    return reduced;
  }

  void Move(const ReducedPair& reduced, const Vector4& step) {
    motion_ = Perturbed(motion_, reduced.pose_step + reduced.pose_from_correction * step);
  }

 private:
  Eigen::Vector3d ErrorsOf(const PointPair& point, const Rigid3& motion,
                           const Vector4& correction) const {
    return Errors(camera_, point, motion, correction, time_sigma_);
  }

  double MedianError(const Vector4& correction) const {
    std::vector<double> norms;
    for (const PointPair& point : pair_.motion.points) {
      norms.push_back(ErrorsOf(point, motion_, correction).norm());
    }
    return Median(std::move(norms)) / 1.54;  // median of the norm of three standard normal deviates
  }

  // Columns: rotation and translation of the pose (left perturbation), correction.
  Eigen::Matrix<double, 3, 10> Jacobian(const PointPair& point, const Vector4& correction) const {
    constexpr double kStep = 1e-5;
    Eigen::Matrix<double, 3, 10> jacobian;
    for (int i = 0; i < 6; ++i) {
      const Vector6 step = kStep * Vector6::Unit(i);
      jacobian.col(i) = (ErrorsOf(point, Perturbed(motion_, step), correction) -
                         ErrorsOf(point, Perturbed(motion_, -step), correction)) /
                        (2.0 * kStep);
    }
    for (int i = 0; i < 4; ++i) {
      const Vector4 step = kStep * Vector4::Unit(i);
      jacobian.col(6 + i) = (ErrorsOf(point, motion_, correction + step) -
                             ErrorsOf(point, motion_, correction - step)) /
                            (2.0 * kStep);
    }
    return jacobian;
  }

  const PinholeCamera& camera_;
  const MotionPair& pair_;
  Rigid3 motion_;
  double time_sigma_;  // pixels
};

// Sums of the reduced normal equations over groups of consecutive pairs.
struct GroupedEquations {
  std::array<Eigen::Matrix4d, kGroups> matrices;
  std::array<Vector4, kGroups> gradients;

  GroupedEquations() {
    matrices.fill(Eigen::Matrix4d::Zero());
    gradients.fill(Vector4::Zero());
  }
  Eigen::Matrix4d Matrix() const {
    Eigen::Matrix4d sum = kPrior.cwiseAbs2().cwiseInverse().asDiagonal();
    for (const Eigen::Matrix4d& matrix : matrices) sum += matrix;
    return sum;
  }
  Vector4 Gradient(const Vector4& correction) const {
    Vector4 sum = kPrior.cwiseAbs2().cwiseInverse().cwiseProduct(correction);
    for (const Vector4& gradient : gradients) sum += gradient;
    return sum;
  }
  // Covariance that allows for any correlation within a group.
  Eigen::Matrix4d Covariance() const {
    Eigen::Matrix4d scatter = Eigen::Matrix4d::Zero();
    for (const Vector4& gradient : gradients) scatter += gradient * gradient.transpose();
    const Eigen::Matrix4d inverse = Matrix().inverse();
    return inverse + kGroups / (kGroups - 1.0) * inverse * scatter * inverse;
  }
};

}  // namespace

std::optional<CalibrationEstimate> EstimatePairCalibration(const PinholeCamera& camera,
                                                           const MotionTrack& track) {
  const std::vector<MotionPair>& pairs = track.pairs;
  if (pairs.size() < kMinPairs) return std::nullopt;
  std::vector<PairProblem> problems;
  for (const MotionPair& pair : pairs) problems.emplace_back(camera, track, pair);
  Vector4 correction = Vector4::Zero();
  GroupedEquations equations;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    equations = GroupedEquations();
    std::vector<ReducedPair> reduced;
    for (size_t i = 0; i < problems.size(); ++i) {
      reduced.push_back(problems[i].Linearize(correction));
      const size_t group = i * kGroups / problems.size();
      equations.matrices[group] += reduced.back().matrix;
      equations.gradients[group] += reduced.back().gradient;
    }
    const Vector4 step = -equations.Matrix().ldlt().solve(equations.Gradient(correction));
    if (!step.allFinite()) return std::nullopt;
    correction += step;
    for (size_t i = 0; i < problems.size(); ++i) problems[i].Move(reduced[i], step);
  }
  const Vector4 sigmas = equations.Covariance().diagonal().cwiseSqrt();
  const double focal_length = camera.FocalLength() * std::exp(correction(0));
  CalibrationEstimate estimate;
  estimate.given_focal_length = camera.FocalLength();
  estimate.focal_length = {focal_length, focal_length * sigmas(0)};
  estimate.given_cx = camera.cx;
  estimate.cx = {camera.cx + camera.fx * correction(1), std::abs(camera.fx) * sigmas(1)};
  estimate.given_cy = camera.cy;
  estimate.cy = {camera.cy + camera.fy * correction(2), std::abs(camera.fy) * sigmas(2)};
  estimate.k1 = {correction(3), sigmas(3)};
  return estimate;
}

}  // namespace msc_vo
