// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/self_calibration/pair_linearization.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

#include "msc_vo/factors/camera_factor.h"
#include "msc_vo/factors/robust_loss.h"
#include "msc_vo/geometry/so3.h"
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
constexpr HuberLoss kLoss{2.448};
constexpr double kOutlierSigmas = 3.368;
constexpr double kMedianSigmas = 1.538;
using PoseMatrix = Eigen::Matrix<double, kPoseSize, kPoseSize>;
using PoseVector = Eigen::Matrix<double, kPoseSize, 1>;

// Rows of one point, whitened.
struct Rows {
  Eigen::Vector3d residual = Eigen::Vector3d::Zero();
  Eigen::Matrix<double, 3, kPoseSize> pose;
  Eigen::Matrix<double, 3, kSize> correction;
  bool is_defined = false;

  double Sigmas() const { return residual.norm(); }
};

// Sum over the points of a pair.
struct NormalEquations {
  PoseMatrix pose = PoseMatrix::Zero();
  Eigen::Matrix<double, kPoseSize, kSize> coupling =
      Eigen::Matrix<double, kPoseSize, kSize>::Zero();
  SensorCorrection::Matrix correction = SensorCorrection::Matrix::Zero();
  PoseVector pose_gradient = PoseVector::Zero();
  SensorCorrection::Vector correction_gradient = SensorCorrection::Vector::Zero();
  double weight = 0.0;  // sum of the weights of the points

  void Add(const Rows& rows, double factor) {
    pose.noalias() += factor * rows.pose.transpose() * rows.pose;
    coupling.noalias() += factor * rows.pose.transpose() * rows.correction;
    correction.noalias() += factor * rows.correction.transpose() * rows.correction;
    pose_gradient.noalias() += factor * rows.pose.transpose() * rows.residual;
    correction_gradient.noalias() += factor * rows.correction.transpose() * rows.residual;
    weight += factor;
  }
};

// What the correction tells of a point: its ray and its inverse depths in both images.
template <typename T>
struct PointTerms {
  Eigen::Matrix<T, 2, 1> ray;
  T inverse_depth_a;
  T inverse_depth_b;
};

template <typename T>
PointTerms<T> TermsOf(const CorrectedCamera& camera, const CalibrationPoint& point,
                      const T* correction) {
  const RgbdPairReprojection factor(camera, point.a, point.b, Eigen::Matrix3d::Identity());
  return {camera.Ray<T>(point.a.pixel, correction), factor.InverseDepth(point.a, correction),
          factor.InverseDepth(point.b, correction)};
}

// Residual of RgbdPairReprojection, before it is whitened, of the point `in_b`: its ray in camera b
// times the ratio of the depths.
template <typename T>
Eigen::Matrix<T, 3, 1> Residual(const CorrectedCamera& camera, const CalibrationPoint& point,
                                const Eigen::Matrix<T, 3, 1>& in_b, const T& inverse_depth_a,
                                const T& inverse_depth_b, const T* correction) {
  const T inverse_z = T(1.0) / in_b.z();
  const Eigen::Matrix<T, 2, 1> pixel = camera.Pixel<T>(
      Eigen::Matrix<T, 2, 1>(in_b.x() * inverse_z, in_b.y() * inverse_z), correction);
  return {pixel.x() - point.b.pixel.x(), pixel.y() - point.b.pixel.y(),
          inverse_depth_a * inverse_z - inverse_depth_b};
}

// Adds the derivatives with respect to a left perturbation of the pose, rotation and translation,
// which are the first ones of the jets.
template <typename T>
void PerturbPose(double inverse_depth, Eigen::Matrix<T, 3, 1>* in_b) {
  const Eigen::Vector3d x((*in_b)(0).a, (*in_b)(1).a, (*in_b)(2).a);
  const Eigen::Matrix3d by_rotation = -Skew(x);
  for (int i = 0; i < 3; ++i) {
    (*in_b)(i).v.template head<3>() += by_rotation.row(i).transpose();
    (*in_b)(i).v(3 + i) += inverse_depth;
  }
}

template <int N>
Eigen::Matrix<double, 3, N> JacobianOf(const Eigen::Matrix<ceres::Jet<double, N>, 3, 1>& residual,
                                       Eigen::Vector3d* value) {
  Eigen::Matrix<double, 3, N> jacobian;
  for (int i = 0; i < 3; ++i) {
    (*value)(i) = residual(i).a;
    jacobian.row(i) = residual(i).v.transpose();
  }
  return jacobian;
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
  const Eigen::LLT<Eigen::Matrix3d> root(covariance);
  return root.matrixL().solve(Eigen::Matrix3d::Identity());
}

// Ray of a recorded pixel, for the weights, which a radial-tangential lens hardly changes.
Eigen::Vector3d RayForWeights(const CorrectedCamera& camera, const Eigen::Vector2d& pixel) {
  if (!camera.distortion().IsCropped()) return camera.camera().Ray(pixel);
  const SensorCorrection::Vector none = SensorCorrection::Vector::Zero();
  return camera.Ray<double>(pixel, none.data()).homogeneous();
}

// A pair of images at a given correction.
class PairProblem {
 public:
  PairProblem(const CorrectedCamera& camera, const std::vector<CalibrationPoint>& points,
              const SensorCorrection::Vector& correction)
      : camera_(camera), points_(points), correction_(correction), rows_(points.size()) {
    for (const CalibrationPoint& point : points) {
      terms_.push_back(TermsOf<double>(camera, point, correction.data()));
      weight_rays_.push_back(RayForWeights(camera, point.a.pixel));
    }
  }

  // Linearises all points with respect to the pose.
  const std::vector<Rows>& ByPose(const Rigid3& b_from_a) {
    using Jet = ceres::Jet<double, kPoseSize>;
    const Eigen::Matrix3d rotation = b_from_a.rotation().toRotationMatrix();
    Eigen::Matrix<Jet, kSize, 1> correction;
    for (int i = 0; i < kSize; ++i) correction(i) = Jet(correction_(i));
    for (size_t i = 0; i < points_.size(); ++i) {
      const PointTerms<double>& terms = terms_[i];
      const Eigen::Vector3d x =
          rotation * terms.ray.homogeneous() + terms.inverse_depth_a * b_from_a.translation();
      if (!Begin(i, b_from_a, x)) continue;
      Eigen::Matrix<Jet, 3, 1> in_b(Jet(x.x()), Jet(x.y()), Jet(x.z()));
      PerturbPose(terms.inverse_depth_a, &in_b);
      const auto residual = Residual<Jet>(camera_, points_[i], in_b, Jet(terms.inverse_depth_a),
                                          Jet(terms.inverse_depth_b), correction.data());
      rows_[i].pose = sqrt_information_ * JacobianOf<kPoseSize>(residual, &rows_[i].residual);
      rows_[i].residual = (sqrt_information_ * rows_[i].residual).eval();
    }
    return rows_;
  }

  // Linearises all points with respect to pose and correction.
  const std::vector<Rows>& ByPoseAndCorrection(const Rigid3& b_from_a) {
    using Jet = ceres::Jet<double, kPoseSize + kSize>;
    const Eigen::Matrix3d rotation = b_from_a.rotation().toRotationMatrix();
    Eigen::Matrix<Jet, kSize, 1> correction;
    for (int i = 0; i < kSize; ++i) correction(i) = Jet(correction_(i), kPoseSize + i);
    for (size_t i = 0; i < points_.size(); ++i) {
      const PointTerms<Jet> terms = TermsOf<Jet>(camera_, points_[i], correction.data());
      Eigen::Matrix<Jet, 3, 1> in_b;
      for (int r = 0; r < 3; ++r) {
        in_b(r) = terms.ray.x() * rotation(r, 0) + terms.ray.y() * rotation(r, 1) + rotation(r, 2) +
                  terms.inverse_depth_a * b_from_a.translation()(r);
      }
      if (!Begin(i, b_from_a, {in_b(0).a, in_b(1).a, in_b(2).a})) continue;
      PerturbPose(terms.inverse_depth_a.a, &in_b);
      const auto residual = Residual<Jet>(camera_, points_[i], in_b, terms.inverse_depth_a,
                                          terms.inverse_depth_b, correction.data());
      const Eigen::Matrix<double, 3, kPoseSize + kSize> jacobian =
          sqrt_information_ * JacobianOf<kPoseSize + kSize>(residual, &rows_[i].residual);
      rows_[i].residual = (sqrt_information_ * rows_[i].residual).eval();
      rows_[i].pose = jacobian.leftCols<kPoseSize>();
      rows_[i].correction = jacobian.rightCols<kSize>();
    }
    return rows_;
  }

 private:
  // Sets is_defined and the weight of point `i` at `in_b`, and returns the former.
  bool Begin(size_t i, const Rigid3& b_from_a, const Eigen::Vector3d& in_b) {
    const CalibrationPoint& point = points_[i];
    const Eigen::Vector3d x_in_b =
        b_from_a.rotation() * weight_rays_[i] + point.inverse_depth * b_from_a.translation();
    rows_[i].is_defined = x_in_b.z() >= kMinCameraDepth && in_b.z() >= kMinCameraDepth;
    if (rows_[i].is_defined) {
      sqrt_information_ = SqrtInformation(camera_.camera(), x_in_b, b_from_a.translation(),
                                          point.inverse_depth, point.pixel_variance);
    }
    return rows_[i].is_defined;
  }

  const CorrectedCamera& camera_;
  const std::vector<CalibrationPoint>& points_;
  SensorCorrection::Vector correction_;
  std::vector<PointTerms<double>> terms_;
  std::vector<Eigen::Vector3d> weight_rays_;
  Eigen::Matrix3d sqrt_information_;
  std::vector<Rows> rows_;
};

double Median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Weights: sigmas are inflated as far as the median residual requires it. Outliers are
// down-weighted, or rejected if `rejects_outliers`.
NormalEquations SumUp(const std::vector<Rows>& all, bool rejects_outliers) {
  std::vector<double> sigmas;
  for (const Rows& rows : all) {
    if (rows.is_defined) sigmas.push_back(rows.Sigmas());
  }
  if (sigmas.empty()) return {};
  const double scale = std::max(1.0, Median(sigmas) / kMedianSigmas);
  NormalEquations equations;
  for (const Rows& rows : all) {
    const double s = rows.Sigmas() / scale;
    if (!rows.is_defined || (rejects_outliers && s > kOutlierSigmas)) continue;
    const double loss = rejects_outliers ? 1.0 : kLoss.Weight(s * s);
    equations.Add(rows, loss / (scale * scale));
  }
  return equations;
}

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
  return Median(std::move(variances));
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
  PairProblem problem(camera, points, correction);
  Rigid3 pose = *b_from_a;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    const NormalEquations equations = SumUp(problem.ByPose(pose), iteration >= kRobustIterations);
    const PoseVector step = -equations.pose.ldlt().solve(equations.pose_gradient);
    if (!step.allFinite()) return std::nullopt;
    pose = Rigid3(ExpSO3(step.head<3>()), step.tail<3>()) * pose;
  }
  const NormalEquations equations = SumUp(problem.ByPoseAndCorrection(pose), true);
  *b_from_a = pose;
  CalibrationInformation information = Marginalize(equations, correction);
  information.point_information = equations.weight / MedianVariance(points);
  return information;
}

}  // namespace msc_vo
