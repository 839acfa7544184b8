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
#include "msc_vo/geometry/camera_velocity.h"
#include "msc_vo/geometry/so3.h"
#include "msc_vo/map/rolling_shutter.h"

namespace msc_vo {

namespace {

constexpr size_t kMinPairs = 8;
constexpr int kIterations = 12;
constexpr int kGroups = 8;
// Uncertainty of the time of a pixel, and of the delay between colour and depth, seconds.
constexpr double kTimeSigma = 0.002, kDelaySigma = 0.008;
constexpr double kMinScale = 0.7;  // of the errors, in sigmas of the features

// Corrections of the calibration: logarithm of the focal length, shift of the principal point in
// focal lengths, k1, and the readout time of a rolling shutter in seconds, which would otherwise
// appear as a wrong calibration.
constexpr int kCorrections = 5;
using Correction = Eigen::Matrix<double, kCorrections, 1>;
constexpr int kUnknowns = 6 + kCorrections;  // with the pose of a pair
using CorrectionMatrix = Eigen::Matrix<double, kCorrections, kCorrections>;
using Vector6 = Eigen::Matrix<double, 6, 1>;
// Standard deviations of the corrections before any image is seen.
const Correction kPrior = (Correction() << 0.3, 0.2, 0.2, 0.3, 0.03).finished();

Eigen::Vector3d CorrectedRay(const PinholeCamera& camera, const Eigen::Vector2d& pixel,
                             const Correction& correction) {
  const Eigen::Vector3d ray = camera.Ray(pixel);
  const double scale = std::exp(-correction(0));
  const double x = scale * (ray.x() - correction(1));
  const double y = scale * (ray.y() - correction(2));
  // The first-order inverse of the distortion 1 + k1 r^2.
  const double radial = 1.0 - correction(3) * (x * x + y * y);
  return {radial * x, radial * y, 1.0};
}

// Velocities of the two images of a pair, and the error by the uncertainty of time, pixels.
struct PairMotion {
  CameraVelocity from;
  CameraVelocity to;
  double time_sigma = 0.0;
};

// Derivative of a ray with respect to the readout time, see RayChange().
Eigen::Vector3d RowChange(const PinholeCamera& camera, const CameraVelocity& velocity,
                          const Eigen::Vector2d& pixel, double inverse_depth) {
  return -RowPhase(camera, pixel) *
         (velocity.angular.cross(camera.Ray(pixel)) + inverse_depth * velocity.linear);
}

// Errors in sigmas: reprojection along x and y, and inverse depth in the second image.
Eigen::Vector3d Errors(const PinholeCamera& camera, const PointPair& pair, const Rigid3& motion,
                       const Correction& correction, const PairMotion& context) {
  const double inverse_depth = pair.from.inverse_depth;
  const double to_inverse_depth =
      pair.to.HasDepth() ? pair.to.inverse_depth : pair.from.inverse_depth;
  const Eigen::Vector3d from =
      CorrectedRay(camera, pair.from.pixel, correction) +
      correction(4) * RowChange(camera, context.from, pair.from.pixel, inverse_depth);
  const Eigen::Vector3d to =
      CorrectedRay(camera, pair.to.pixel, correction) +
      correction(4) * RowChange(camera, context.to, pair.to.pixel, to_inverse_depth);
  const Eigen::Vector3d moved = motion.rotation() * from + inverse_depth * motion.translation();
  const double focal_length = camera.FocalLength() * std::exp(correction(0));
  const double parallax = focal_length * motion.translation().norm();
  const double sigma = std::sqrt(pair.from.sigma * pair.from.sigma + pair.to.sigma * pair.to.sigma +
                                 context.time_sigma * context.time_sigma +
                                 std::pow(parallax * pair.from.inverse_depth_sigma, 2));
  Eigen::Vector3d errors;
  errors.head<2>() = focal_length / sigma * (moved.head<2>() / moved.z() - to.head<2>() / to.z());
  errors.z() = 0.0;
  if (pair.to.HasDepth()) {
    const double depth_sigma =
        std::hypot(pair.from.inverse_depth_sigma, pair.to.inverse_depth_sigma);
    errors.z() = (inverse_depth / moved.z() - pair.to.inverse_depth / to.z()) / depth_sigma;
  }
  return errors;
}

Rigid3 Perturbed(const Rigid3& motion, const Vector6& step) {
  return Rigid3(ExpSO3(step.head<3>()), step.tail<3>()) * motion;
}

// Normal equations of one pair after its pose has been eliminated, and what recovers its pose step.
struct ReducedPair {
  CorrectionMatrix matrix = CorrectionMatrix::Zero();
  Correction gradient = Correction::Zero();
  Eigen::Matrix<double, 6, kCorrections> pose_from_correction;
  Vector6 pose_step;
};

class PairProblem {
 public:
  PairProblem(const PinholeCamera& camera, const MotionTrack& track, const MotionPair& pair)
      : camera_(camera),
        pair_(pair),
        motion_(pair.motion.to_from_from),
        context_{track.images[pair.from].camera_velocity, track.images[pair.to].camera_velocity,
                 kTimeSigma * std::hypot(track.images[pair.from].velocity.norm(),
                                         track.images[pair.to].velocity.norm())} {}

  ReducedPair Linearize(const Correction& correction) const {
    const double scale = std::max(kMinScale, MedianError(correction));
    Eigen::Matrix<double, kUnknowns, kUnknowns> matrix =
        1e-6 * Eigen::Matrix<double, kUnknowns, kUnknowns>::Identity();
    Eigen::Matrix<double, kUnknowns, 1> gradient = Eigen::Matrix<double, kUnknowns, 1>::Zero();
    for (const PointPair& point : pair_.motion.points) {
      const Eigen::Vector3d errors = ErrorsOf(point, motion_, correction);
      const Eigen::Matrix<double, 3, kUnknowns> jacobian = Jacobian(point, correction);
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
    reduced.pose_from_correction = -pose.solve(matrix.topRightCorner<6, kCorrections>());
    reduced.pose_step = -pose.solve(gradient.head<6>());
    reduced.matrix = matrix.bottomRightCorner<kCorrections, kCorrections>() +
                     matrix.bottomLeftCorner<kCorrections, 6>() * reduced.pose_from_correction;
    reduced.gradient = gradient.tail<kCorrections>() +
                       matrix.bottomLeftCorner<kCorrections, 6>() * reduced.pose_step;
    return reduced;
  }

  void Move(const ReducedPair& reduced, const Correction& step) {
    motion_ = Perturbed(motion_, reduced.pose_step + reduced.pose_from_correction * step);
  }

 private:
  Eigen::Vector3d ErrorsOf(const PointPair& point, const Rigid3& motion,
                           const Correction& correction) const {
    return Errors(camera_, point, motion, correction, context_);
  }

  double MedianError(const Correction& correction) const {
    std::vector<double> norms;
    for (const PointPair& point : pair_.motion.points) {
      norms.push_back(ErrorsOf(point, motion_, correction).norm());
    }
    return Median(std::move(norms)) / 1.54;  // median of the norm of three standard normal deviates
  }

  // Columns: rotation and translation of the pose (left perturbation), correction.
  Eigen::Matrix<double, 3, kUnknowns> Jacobian(const PointPair& point,
                                               const Correction& correction) const {
    constexpr double kStep = 1e-5;
    Eigen::Matrix<double, 3, kUnknowns> jacobian;
    for (int i = 0; i < 6; ++i) {
      const Vector6 step = kStep * Vector6::Unit(i);
      jacobian.col(i) = (ErrorsOf(point, Perturbed(motion_, step), correction) -
                         ErrorsOf(point, Perturbed(motion_, -step), correction)) /
                        (2.0 * kStep);
    }
    for (int i = 0; i < kCorrections; ++i) {
      const Correction step = kStep * Correction::Unit(i);
      jacobian.col(6 + i) = (ErrorsOf(point, motion_, correction + step) -
                             ErrorsOf(point, motion_, correction - step)) /
                            (2.0 * kStep);
    }
    return jacobian;
  }

  const PinholeCamera& camera_;
  const MotionPair& pair_;
  Rigid3 motion_;
  PairMotion context_;
};

// Sums of the reduced normal equations over groups of consecutive pairs.
struct GroupedEquations {
  std::array<CorrectionMatrix, kGroups> matrices;
  std::array<Correction, kGroups> gradients;

  GroupedEquations() {
    matrices.fill(CorrectionMatrix::Zero());
    gradients.fill(Correction::Zero());
  }
  CorrectionMatrix Matrix() const {
    CorrectionMatrix sum = kPrior.cwiseAbs2().cwiseInverse().asDiagonal();
    for (const CorrectionMatrix& matrix : matrices) sum += matrix;
    return sum;
  }
  Correction Gradient(const Correction& correction) const {
    Correction sum = kPrior.cwiseAbs2().cwiseInverse().cwiseProduct(correction);
    for (const Correction& gradient : gradients) sum += gradient;
    return sum;
  }
  // Covariance that allows for any correlation within a group.
  CorrectionMatrix Covariance() const {
    CorrectionMatrix scatter = CorrectionMatrix::Zero();
    for (const Correction& gradient : gradients) scatter += gradient * gradient.transpose();
    const CorrectionMatrix inverse = Matrix().inverse();
    return inverse + kGroups / (kGroups - 1.0) * inverse * scatter * inverse;
  }
};

// Pixels per second.
double MedianSpeed(const MotionTrack& track) {
  std::vector<double> speeds;
  for (const MotionImage& image : track.images) {
    if (image.linked) speeds.push_back(image.velocity.norm());
  }
  return Median(std::move(speeds));
}

}  // namespace

std::optional<CalibrationEstimate> EstimatePairCalibration(const PinholeCamera& camera,
                                                           const MotionTrack& track) {
  const std::vector<MotionPair>& pairs = track.pairs;
  if (pairs.size() < kMinPairs) return std::nullopt;
  std::vector<PairProblem> problems;
  for (const MotionPair& pair : pairs) problems.emplace_back(camera, track, pair);
  Correction correction = Correction::Zero();
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
    const Correction step = -equations.Matrix().ldlt().solve(equations.Gradient(correction));
    if (!step.allFinite()) return std::nullopt;
    correction += step;
    for (size_t i = 0; i < problems.size(); ++i) problems[i].Move(reduced[i], step);
  }
  Correction sigmas = equations.Covariance().diagonal().cwiseSqrt();
  // Delays are common to all pairs: at a given speed they shift the image, or stretch it if the
  // shift varies over it.
  const double shift = kDelaySigma * MedianSpeed(track);
  sigmas(0) = std::hypot(sigmas(0), shift / (0.5 * camera.width));
  sigmas(1) = std::hypot(sigmas(1), shift / camera.FocalLength());
  sigmas(2) = std::hypot(sigmas(2), shift / camera.FocalLength());
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
