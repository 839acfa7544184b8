// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/self_calibration/calibration_pair.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

#include "msc_vo/factors/rigid3_manifold.h"
#include "msc_vo/factors/robust_loss.h"
#include "msc_vo/map/rolling_shutter.h"
#include "msc_vo/matching/point_matcher.h"
#include "msc_vo/self_calibration/surface_plane.h"
#include "msc_vo/sensor/sensor_noise.h"

namespace msc_vo {

namespace {

constexpr int kSize = SensorCorrection::kSize;
constexpr int kPoseSize = 6;
// Six unknowns of the pose need a few points; more are required as a protection against outliers.
constexpr int kMinPoints = 30;
// Search radius, pixels: exceeds what a focal length that is 5 % off moves a point in half an
// image.
constexpr double kSearchRadius = 30.0;
// The robust iterations find the inliers; the last ones use the inliers alone.
constexpr int kRobustIterations = 2;
constexpr int kIterations = 4;
// Square roots of the 95 %, 99 % and 50 % quantiles of chi-square with two, three and three degrees
// of freedom.
constexpr HuberLoss kLoss{2.448};
constexpr double kOutlierSigmas = 3.368;
constexpr double kMedianSigmas = 1.538;
// Standard deviation, pixels, of the error that the points of a pair have in common; as for the
// readout time (docs/lab/self_calibration.md).
constexpr double kCommonError = 0.2;
// Relative error of the velocity by which a rolling shutter is compensated. It comes from the
// motion between the neighbouring images.
constexpr double kVelocityError = 0.1;

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

Rows Linearize(const RgbdPairReprojection& factor, const Rigid3& b_from_a,
               const SensorCorrection::Vector& correction) {
  static const Rigid3Manifold manifold;
  const ceres::AutoDiffCostFunction<RgbdPairReprojection, 3, 7, kSize> cost(
      new RgbdPairReprojection(factor));
  Eigen::Matrix<double, 3, 7, Eigen::RowMajor> by_params;
  Eigen::Matrix<double, 3, kSize, Eigen::RowMajor> by_correction;
  Eigen::Matrix<double, 7, kPoseSize, Eigen::RowMajor> plus;
  const double* blocks[] = {b_from_a.params.data(), correction.data()};
  double* jacobians[] = {by_params.data(), by_correction.data()};
  Rows rows;
  rows.is_defined = cost.Evaluate(blocks, rows.residual.data(), jacobians);
  if (!rows.is_defined) return rows;
  manifold.PlusJacobian(b_from_a.params.data(), plus.data());
  rows.pose = by_params * plus;
  rows.correction = by_correction;
  return rows;
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

// Recorded pixel of a point before the compensation of the rolling shutter.
Eigen::Vector2d PixelBeforeCompensation(const Frame& frame, const PointFeature& point) {
  if (!frame.velocity || frame.readout_time == 0.0) return point.pixel;
  return frame.camera.Project(frame.camera.Ray(point.pixel) -
                              frame.readout_time *
                                  RayChange(frame, point.pixel, point.inverse_depth));
}

RgbdPairReprojection::View MakeView(const LensDistortion& distortion, const Frame& frame,
                                    const PointFeature& point) {
  const auto recorded = [&](const Eigen::Vector2d& pixel) {
    return distortion.IsZero() ? pixel : distortion.Distort(frame.camera, pixel);
  };
  RgbdPairReprojection::View view;
  view.pixel = recorded(point.pixel);
  view.recorded_pixel = recorded(PixelBeforeCompensation(frame, point));
  return view;
}

// Ray of a recorded pixel, for the weights, which a radial-tangential lens hardly changes.
Eigen::Vector3d RayForWeights(const CorrectedCamera& camera, const Eigen::Vector2d& pixel) {
  if (!camera.distortion().IsCropped()) return camera.camera().Ray(pixel);
  const SensorCorrection::Vector none = SensorCorrection::Vector::Zero();
  return camera.Ray<double>(pixel, none.data()).homogeneous();
}

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

// Variance, pixels^2, of the error that the points of an image have in common.
double CommonVariance(const Frame& frame) {
  const double shift = frame.velocity ? frame.camera.FocalLength() * frame.readout_time *
                                            frame.velocity->angular.norm()
                                      : 0.0;
  return 0.5 * kCommonError * kCommonError + kVelocityError * kVelocityError * shift * shift;
}

// Eliminates the pose and limits the information by the common error, whose variance is
// `variance_ratio` times that of a point.
CalibrationInformation Marginalize(const NormalEquations& equations,
                                   const SensorCorrection::Vector& at, double variance_ratio) {
  const Eigen::LDLT<PoseMatrix> pose(equations.pose);
  const double factor = 1.0 / (1.0 + variance_ratio * equations.weight);
  CalibrationInformation information;
  information.matrix = factor * (equations.correction -
                                 equations.coupling.transpose() * pose.solve(equations.coupling));
  const SensorCorrection::Vector gradient =
      factor * (equations.correction_gradient -
                equations.coupling.transpose() * pose.solve(equations.pose_gradient));
  information.vector = information.matrix * at - gradient;
  return information;
}

}  // namespace

CalibrationPair::CalibrationPair(const CorrectedCamera& camera, const CalibrationView* a,
                                 const CalibrationView* b)
    : camera_(camera), a_(a), b_(b) {
  const Frame& from = *a->frame;
  const Frame& to = *b->frame;
  for (const PointMatch& match :
       MatchFrames(from, a->cam_from_world, to, b->cam_from_world, kSearchRadius)) {
    const PointFeature& in_a = from.points[match.id];
    const PointFeature& in_b = to.points[match.feature];
    points_.push_back({MakeView(camera.distortion(), from, in_a),
                       MakeView(camera.distortion(), to, in_b), in_a.inverse_depth,
                       in_a.sigma * in_a.sigma + in_b.sigma * in_b.sigma});
  }
}

std::optional<CalibrationInformation> CalibrationPair::Linearize(
    const SensorCorrection::Vector& correction) const {
  std::vector<Point> points;
  std::vector<double> variances;
  for (Point point : points_) {
    const auto in_a = FindSurface(camera_, a_->depth, point.a.recorded_pixel, correction);
    const auto in_b = FindSurface(camera_, b_->depth, point.b.recorded_pixel, correction);
    if (!in_a || !in_b) continue;
    point.a.surface = *in_a;
    point.b.surface = *in_b;
    points.push_back(point);
    variances.push_back(point.pixel_variance);
  }
  if (points.size() < kMinPoints) return std::nullopt;
  Rigid3 b_from_a = b_->cam_from_world * a_->cam_from_world.Inverse();
  std::vector<Rows> rows(points.size());
  for (int iteration = 0;; ++iteration) {
    for (size_t i = 0; i < points.size(); ++i) {
      const Point& point = points[i];
      const Eigen::Vector3d ray = RayForWeights(camera_, point.a.pixel);
      const Eigen::Vector3d x_in_b =
          b_from_a.rotation() * ray + point.inverse_depth * b_from_a.translation();
      if (x_in_b.z() < kMinCameraDepth) {
        rows[i].is_defined = false;
        continue;
      }
      const RgbdPairReprojection factor(
          camera_, point.a, point.b,
          SqrtInformation(camera_.camera(), x_in_b, b_from_a.translation(), point.inverse_depth,
                          point.pixel_variance));
      rows[i] = msc_vo::Linearize(factor, b_from_a, correction);
    }
    const NormalEquations equations = SumUp(rows, iteration >= kRobustIterations);
    if (iteration == kIterations) {
      const double common = CommonVariance(*a_->frame) + CommonVariance(*b_->frame);
      return Marginalize(equations, correction, common / Median(variances));
    }
    const PoseVector step = -equations.pose.ldlt().solve(equations.pose_gradient);
    if (!step.allFinite()) return std::nullopt;
    Rigid3 next;
    Rigid3Manifold().Plus(b_from_a.params.data(), step.data(), next.params.data());
    b_from_a = next;
  }
}

}  // namespace msc_vo
