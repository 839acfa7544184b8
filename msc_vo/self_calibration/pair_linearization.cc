// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/self_calibration/pair_linearization.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Cholesky>

#include "msc_vo/factors/camera_factor.h"
#include "msc_vo/factors/chi_square.h"
#include "msc_vo/factors/robust_loss.h"
#include "msc_vo/geometry/quantile.h"
#include "msc_vo/geometry/so3.h"
#include "msc_vo/self_calibration/linearized_camera.h"
#include "msc_vo/sensor/sensor_noise.h"

namespace msc_vo {

namespace {

constexpr int kSize = SensorCorrection::kSize;
constexpr int kPoseSize = 6;
// Six unknowns of the pose need a few points; more are required as a protection against outliers.
constexpr size_t kMinPoints = 30;
// The robust iterations find the inliers; the last ones use the inliers alone.
constexpr int kRobustIterations = 2;
constexpr int kIterations = 4;
// Square roots of the 95 %, 99 % and 50 % quantiles of chi-square with two, three and three degrees
// of freedom.
constexpr HuberLoss kLoss{kHuberThreshold[2]};
constexpr double kOutlierSigmas = 3.368;
constexpr double kMedianSigmas = 1.538;
using PoseMatrix = Eigen::Matrix<double, kPoseSize, kPoseSize>;
using PoseVector = Eigen::Matrix<double, kPoseSize, 1>;

// Rows of one point, whitened.
struct Rows {
  Eigen::Vector3d residual = Eigen::Vector3d::Zero();
  Eigen::Matrix<double, 3, kPoseSize> pose;
  double sigmas = 0.0;  // norm of the residual
  bool is_defined = false;
};

// Sum over the points of a pair.
struct NormalEquations {
  PoseMatrix pose = PoseMatrix::Zero();
  PoseVector pose_gradient = PoseVector::Zero();
  Eigen::Matrix<double, kPoseSize, kSize> coupling =
      Eigen::Matrix<double, kPoseSize, kSize>::Zero();
  SensorCorrection::Matrix correction = SensorCorrection::Matrix::Zero();
  SensorCorrection::Vector correction_gradient = SensorCorrection::Vector::Zero();
  double weight = 0.0;  // sum of the weights of the points

  void Add(const Rows& rows, double factor) {
    const Eigen::Matrix<double, kPoseSize, 3> weighted = factor * rows.pose.transpose();
    pose += weighted.lazyProduct(rows.pose);
    pose_gradient += weighted.lazyProduct(rows.residual);
    weight += factor;
  }
  // `by_correction`: derivative of the rows with respect to the correction.
  void AddCorrection(const Rows& rows, const Eigen::Matrix<double, 3, kSize>& by_correction,
                     double factor) {
    const Eigen::Matrix<double, kSize, 3> weighted = factor * by_correction.transpose();
    coupling += rows.pose.transpose().lazyProduct(weighted.transpose());
    correction += weighted.lazyProduct(by_correction);
    correction_gradient += weighted.lazyProduct(rows.residual);
  }
};

// Inverse of the lower triangular root of a covariance.
Eigen::Matrix3d SqrtInverse(const Eigen::Matrix3d& covariance) {
  const double l11 = std::sqrt(covariance(0, 0));
  const double l21 = covariance(1, 0) / l11;
  const double l31 = covariance(2, 0) / l11;
  const double l22 = std::sqrt(covariance(1, 1) - l21 * l21);
  const double l32 = (covariance(2, 1) - l31 * l21) / l22;
  const double l33 = std::sqrt(covariance(2, 2) - l31 * l31 - l32 * l32);
  Eigen::Matrix3d inverse = Eigen::Matrix3d::Zero();
  inverse.diagonal() << 1.0 / l11, 1.0 / l22, 1.0 / l33;
  inverse(1, 0) = -l21 * inverse(0, 0) * inverse(1, 1);
  inverse(2, 0) = -(l31 * inverse(0, 0) + l32 * inverse(1, 0)) * inverse(2, 2);
  inverse(2, 1) = -l32 * inverse(1, 1) * inverse(2, 2);
  return inverse;
}

// Square root of the information of the rows of a point: the errors of its pixels, and of its depth
// in both images. The random error of the pixels of a plane hardly counts, that of the sensor over
// a region does. `x_in_b` is its ray in camera b times the ratio of the depths.
Eigen::Matrix3d SqrtInformation(const PinholeCamera& camera, const Eigen::Vector3d& x_in_b,
                                const Eigen::Vector3d& translation, double inverse_depth,
                                double pixel_variance) {
  const double z = x_in_b.z();
  Eigen::Vector3d by_inverse_depth;
  by_inverse_depth << ProjectionJacobian(camera, x_in_b) * translation,
      (1.0 - inverse_depth * translation.z() / z) / z;
  const double sigma = SensorNoiseOptions().inverse_depth_sigma;
  const double variance = sigma * sigma;
  Eigen::Matrix3d covariance = variance * by_inverse_depth * by_inverse_depth.transpose();
  covariance.diagonal() += Eigen::Vector3d(pixel_variance, pixel_variance, variance);
  return SqrtInverse(covariance);
}

// Ray of a recorded pixel, for the weights: those of a lens whose undistorted image is not cropped
// hardly depend on its distortion.
Eigen::Vector3d RayForWeights(const CorrectedCamera& camera, const Eigen::Vector2d& pixel) {
  if (!camera.distortion().IsCropped()) return camera.camera().Ray(pixel);
  const SensorCorrection::Vector none = SensorCorrection::Vector::Zero();
  return camera.Ray<double>(pixel, none.data()).homogeneous();
}

// A pair of images at a given correction. The points are weighted at the first pose.
class PairProblem {
 public:
  PairProblem(const CorrectedCamera& camera, const std::vector<CalibrationPoint>& points,
              const SensorCorrection::Vector& correction, const Rigid3& b_from_a)
      : camera_(camera, correction), rows_(points.size()) {
    terms_.reserve(points.size());
    const Eigen::Matrix3d rotation = b_from_a.rotation().toRotationMatrix();
    for (const CalibrationPoint& point : points) {
      Terms terms{&point, camera_.Ray(point.a.pixel), camera_.InverseDepth(point.a, nullptr),
                  camera_.InverseDepth(point.b, nullptr), Eigen::Matrix3d::Zero()};
      const Eigen::Vector3d x_in_b = rotation * RayForWeights(camera, point.a.pixel) +
                                     point.inverse_depth * b_from_a.translation();
      if (x_in_b.z() >= kMinCameraDepth) {
        terms.sqrt_information = SqrtInformation(camera.camera(), x_in_b, b_from_a.translation(),
                                                 point.inverse_depth, point.pixel_variance);
      }
      terms_.push_back(terms);
    }
  }

  // Linearises with respect to the pose.
  void SetPose(const Rigid3& b_from_a) {
    rotation_ = b_from_a.rotation().toRotationMatrix();
    translation_ = b_from_a.translation();
    for (size_t i = 0; i < terms_.size(); ++i) LinearizePoint(terms_[i], &rows_[i]);
  }

  // Sigmas are inflated as far as the median residual requires it. Outliers are down-weighted.
  NormalEquations SumRobustly() const {
    const double scale = Scale();
    NormalEquations equations;
    for (const Rows& rows : rows_) {
      if (!rows.is_defined) continue;
      const double s = rows.sigmas / scale;
      equations.Add(rows, kLoss.Weight(s * s) / (scale * scale));
    }
    return equations;
  }

  // The same without outliers, with the correction or for the pose alone.
  NormalEquations SumInliers(bool with_correction) const {
    const double scale = Scale();
    const double factor = 1.0 / (scale * scale);
    NormalEquations equations;
    for (size_t i = 0; i < rows_.size(); ++i) {
      if (!rows_[i].is_defined || !(rows_[i].sigmas <= kOutlierSigmas * scale)) continue;
      equations.Add(rows_[i], factor);
      if (with_correction) equations.AddCorrection(rows_[i], ByCorrection(terms_[i]), factor);
    }
    return equations;
  }

 private:
  // What the correction says about a point.
  struct Terms {
    const CalibrationPoint* point;
    Eigen::Vector2d ray;
    double inverse_depth_a;
    double inverse_depth_b;
    Eigen::Matrix3d sqrt_information;  // zero: too near
  };

  // The ray of a point in camera b times the ratio of the depths.
  Eigen::Vector3d InB(const Terms& terms) const {
    return rotation_ * terms.ray.homogeneous() + terms.inverse_depth_a * translation_;
  }
  // Derivative of the residual, before it is whitened, with respect to InB().
  Eigen::Matrix3d ByPoint(const Terms& terms, const Eigen::Vector3d& in_b) const {
    const double inverse_z = 1.0 / in_b.z();
    const Eigen::Vector2d x = inverse_z * in_b.head<2>();
    Eigen::Matrix3d by_point;
    by_point.topLeftCorner<2, 2>() = inverse_z * camera_.PixelByPoint(x);
    by_point.topRightCorner<2, 1>() = -by_point.topLeftCorner<2, 2>() * x;
    by_point.row(2) << 0.0, 0.0, -terms.inverse_depth_a * inverse_z * inverse_z;
    return by_point;
  }

  void LinearizePoint(const Terms& terms, Rows* rows) const {
    const Eigen::Vector3d in_b = InB(terms);
    rows->is_defined = terms.sqrt_information(0, 0) > 0.0 && in_b.z() >= kMinCameraDepth;
    if (!rows->is_defined) return;
    const double inverse_z = 1.0 / in_b.z();
    Eigen::Vector3d residual;
    residual << camera_.Pixel(inverse_z * in_b.head<2>()) - terms.point->b.pixel,
        terms.inverse_depth_a * inverse_z - terms.inverse_depth_b;
    rows->is_defined = residual.allFinite();
    if (!rows->is_defined) return;
    rows->residual = terms.sqrt_information * residual;
    rows->sigmas = rows->residual.norm();
    const Eigen::Matrix3d by_point = terms.sqrt_information * ByPoint(terms, in_b);
    // A left perturbation of the pose, rotation and translation.
    rows->pose.leftCols<3>() = by_point * -Skew(in_b);
    rows->pose.rightCols<3>() = terms.inverse_depth_a * by_point;
  }

  // Derivative of the whitened residual with respect to the correction.
  Eigen::Matrix<double, 3, kSize> ByCorrection(const Terms& terms) const {
    constexpr int kColorSize = LinearizedCamera::kColorSize;
    constexpr int kDepthSize = LinearizedCamera::kDepthSize;
    const Eigen::Vector3d in_b = InB(terms);
    const double inverse_z = 1.0 / in_b.z();
    const Eigen::Matrix3d by_point = ByPoint(terms, in_b);
    LinearizedCamera::DepthJacobian by_a, by_b;
    camera_.InverseDepth(terms.point->a, &by_a);
    camera_.InverseDepth(terms.point->b, &by_b);
    Eigen::Vector3d by_inverse_depth = by_point * translation_;
    by_inverse_depth.z() += inverse_z;
    Eigen::Matrix<double, 3, kSize> jacobian;
    jacobian.leftCols<kColorSize>() =
        by_point * (rotation_.leftCols<2>() * camera_.RayByCamera(terms.ray));
    jacobian.topLeftCorner<2, kColorSize>() += camera_.PixelByCamera(inverse_z * in_b.head<2>());
    jacobian.rightCols<kDepthSize>() = by_inverse_depth * by_a;
    jacobian.bottomRightCorner<1, kDepthSize>() -= by_b;
    return terms.sqrt_information * jacobian;
  }

  // Factor of the sigmas.
  double Scale() const {
    std::vector<double> sigmas;
    sigmas.reserve(rows_.size());
    for (const Rows& rows : rows_) {
      if (rows.is_defined) sigmas.push_back(rows.sigmas);
    }
    return sigmas.empty() ? 1.0 : std::max(1.0, UpperMedian(std::move(sigmas)) / kMedianSigmas);
  }

  LinearizedCamera camera_;
  std::vector<Terms> terms_;
  Eigen::Matrix3d rotation_;
  Eigen::Vector3d translation_;
  std::vector<Rows> rows_;
};

// Eliminates the pose.
CalibrationInformation Marginalize(const NormalEquations& equations,
                                   const SensorCorrection::Vector& at) {
  const Eigen::LDLT<PoseMatrix> pose(equations.pose);
  CalibrationInformation information;
  information.matrix =
      equations.correction - equations.coupling.transpose() * pose.solve(equations.coupling);
  const SensorCorrection::Vector gradient =
      equations.correction_gradient -
      equations.coupling.transpose() * pose.solve(equations.pose_gradient);
  information.vector = information.matrix * at - gradient;
  return information;
}

double MedianVariance(const std::vector<CalibrationPoint>& points) {
  std::vector<double> variances;
  for (const CalibrationPoint& point : points) variances.push_back(point.pixel_variance);
  return UpperMedian(std::move(variances));
}

}  // namespace

CalibrationInformation WithCommonError(CalibrationInformation information, double common_variance) {
  const double factor = 1.0 / (1.0 + common_variance * information.point_information);
  information.matrix *= factor;
  information.vector *= factor;
  information.point_information *= factor;
  return information;
}

std::optional<CalibrationInformation> LinearizePair(const CorrectedCamera& camera,
                                                    const std::vector<CalibrationPoint>& points,
                                                    const SensorCorrection::Vector& correction,
                                                    Rigid3* b_from_a) {
  if (points.size() < kMinPoints) return std::nullopt;
  PairProblem problem(camera, points, correction, *b_from_a);
  Rigid3 pose = *b_from_a;
  for (int i = 0; i < kIterations; ++i) {
    problem.SetPose(pose);
    const NormalEquations equations =
        i < kRobustIterations ? problem.SumRobustly() : problem.SumInliers(false);
    const PoseVector step = -equations.pose.ldlt().solve(equations.pose_gradient);
    if (!step.allFinite()) return std::nullopt;
    pose = Rigid3(ExpSO3(step.head<3>()), step.tail<3>()) * pose;
  }
  problem.SetPose(pose);
  const NormalEquations equations = problem.SumInliers(true);
  CalibrationInformation information = Marginalize(equations, correction);
  information.point_information = equations.weight / MedianVariance(points);
  if (!information.matrix.allFinite() || !information.vector.allFinite()) return std::nullopt;
  *b_from_a = pose;
  return information;
}

}  // namespace msc_vo
