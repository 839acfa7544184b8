// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/self_calibration/readout_time_pair.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "msc_vo/factors/camera_factor.h"
#include "msc_vo/factors/chi_square.h"
#include "msc_vo/factors/robust_loss.h"
#include "msc_vo/frame/rolling_shutter.h"
#include "msc_vo/geometry/quantile.h"
#include "msc_vo/geometry/so3.h"
#include "msc_vo/matching/point_matcher.h"
#include "msc_vo/self_calibration/pair_view.h"

namespace msc_vo {

namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Vector7 = Eigen::Matrix<double, 7, 1>;
using Matrix7 = Eigen::Matrix<double, 7, 7>;

// Four matches determine the seven unknowns; more are required as a protection against outliers.
constexpr int kMinPoints = 30;
// Search radius, radians. It exceeds the displacement by fast rotation during the readout, because
// the matches must not depend on the current estimate: the inliers of poses that were estimated
// without compensation bias the readout time. See docs/lab/self_calibration.md.
constexpr double kSearchRadius = 0.04;
// The robust iterations find the inliers; the last two use the inliers alone.
constexpr int kRobustIterations = 3;
constexpr int kIterations = 5;
// Square roots of the 95 %, 99 % and 50 % quantiles of chi-square with two degrees of freedom.
constexpr HuberLoss kLoss{kHuberThreshold[2]};
constexpr double kOutlierSigmas = 3.035;
constexpr double kMedianSigmas = 1.177;
// Damping of the readout time, 1/seconds^2: keeps it unchanged if the points do not determine it.
constexpr double kDamping = 1.0;

struct PointPair {
  const PointFeature* from;
  const PointFeature* to;
};

std::vector<PointPair> MatchKeyframes(const Keyframe& from, const Keyframe& to) {
  std::vector<PointPair> pairs;
  const double radius = kSearchRadius * to.frame->camera.FocalLength();
  for (const PointMatch& match :
       MatchFrames(*from.frame, from.cam_from_world, *to.frame, to.cam_from_world, radius)) {
    pairs.push_back({&from.frame->points[match.id], &to.frame->points[match.feature]});
  }
  return pairs;
}

// Unknowns of the least-squares problem.
struct State {
  Rigid3 relative_pose;       // maps coordinates of the first camera to the second one
  double readout_time = 0.0;  // seconds
};

// Reprojection residual of a point pair. The columns of the Jacobian are rotation and translation
// of the relative pose (left perturbation) and the readout time.
struct Residual {
  Eigen::Vector2d value;  // pixels
  Eigen::Matrix<double, 2, 7> jacobian;
  Eigen::Matrix2d information;  // 1/pixels^2

  double Sigmas() const { return std::sqrt(value.dot(information * value)); }
};

// Sum over the point pairs of two frames.
struct NormalEquations {
  Matrix7 matrix = Matrix7::Zero();
  Vector7 gradient = Vector7::Zero();
  double weight = 0.0;  // 1/pixels^2

  void Add(const Residual& residual, double factor) {
    const Eigen::Matrix<double, 7, 2> weighted =
        factor * residual.jacobian.transpose() * residual.information;
    matrix += weighted * residual.jacobian;
    gradient += weighted * residual.value;
    weight += 0.5 * factor * residual.information.trace();
  }

  // Information of the readout time, marginalised over the pose. The variance of the common error
  // of the residuals, from errors of the depths, the lens model and the velocities that vary with
  // the row like the readout time, bounds it: all points together count at most like one point with
  // this variance.
  double TimeInformation(double common_variance) const {
    const Vector6 coupling = matrix.col(6).head<6>();
    const Vector6 explained = matrix.topLeftCorner<6, 6>().ldlt().solve(coupling);
    const double random = std::max(0.0, matrix(6, 6) - coupling.dot(explained));
    return random / (1.0 + common_variance * weight);
  }
};

class PairProblem {
 public:
  PairProblem(const Frame& from, const Frame& to, const std::vector<PointPair>& pairs)
      : from_(from), to_(to), pairs_(pairs), residuals_(pairs.size()) {}

  // Sigmas are inflated as far as the median residual requires it, because blur and velocity errors
  // increase all residuals. Outliers are down-weighted, or rejected if `rejects_outliers`.
  NormalEquations Linearize(const State& state, bool rejects_outliers) {
    for (size_t i = 0; i < pairs_.size(); ++i) residuals_[i] = ResidualOf(pairs_[i], state);
    const double scale = std::max(1.0, MedianSigmas() / kMedianSigmas);
    NormalEquations equations;
    for (const Residual& residual : residuals_) {
      const double sigmas = residual.Sigmas() / scale;
      if (rejects_outliers && sigmas > kOutlierSigmas) continue;
      equations.Add(residual, kLoss.Weight(sigmas * sigmas) / (scale * scale));
    }
    return equations;
  }

 private:
  Residual ResidualOf(const PointPair& pair, const State& state) const {
    const PinholeCamera& camera = to_.camera;
    const PointFeature& a = *pair.from;
    const PointFeature& b = *pair.to;
    const double b_inverse_depth = b.HasDepth() ? b.inverse_depth : a.inverse_depth;
    const Eigen::Vector3d a_change = RayChange(from_, a.pixel, a.inverse_depth);
    const Eigen::Vector3d b_change = RayChange(to_, b.pixel, b_inverse_depth);
    const Eigen::Vector3d a_ray =
        camera.Ray(a.pixel) + (state.readout_time - from_.readout_time) * a_change;
    const Eigen::Vector3d b_ray =
        camera.Ray(b.pixel) + (state.readout_time - to_.readout_time) * b_change;
    const Eigen::Vector3d moved = state.relative_pose.rotation() * a_ray +
                                  a.inverse_depth * state.relative_pose.translation();

    Residual residual;
    residual.value = camera.Project(moved) - camera.Project(b_ray);
    const Eigen::Matrix<double, 2, 3> projection = ProjectionJacobian(camera, moved);
    residual.jacobian.leftCols<3>() = -projection * Skew(moved);
    residual.jacobian.middleCols<3>(3) = a.inverse_depth * projection;
    residual.jacobian.col(6) = projection * (state.relative_pose.rotation() * a_change) -
                               ProjectionJacobian(camera, b_ray) * b_change;
    const Eigen::Vector2d depth_error =
        a.inverse_depth_sigma * (projection * state.relative_pose.translation());
    const Eigen::Matrix2d covariance =
        (a.sigma * a.sigma + b.sigma * b.sigma) * Eigen::Matrix2d::Identity() +
        depth_error * depth_error.transpose();
    residual.information = covariance.inverse();
    return residual;
  }

  double MedianSigmas() const {
    std::vector<double> sigmas(residuals_.size());
    std::transform(residuals_.begin(), residuals_.end(), sigmas.begin(),
                   [](const Residual& residual) { return residual.Sigmas(); });
    return UpperMedian(std::move(sigmas));
  }

  const Frame& from_;
  const Frame& to_;
  const std::vector<PointPair>& pairs_;
  std::vector<Residual> residuals_;
};

}  // namespace

std::optional<ReadoutTimeEstimate> EstimateReadoutTime(const Keyframe& from, const Keyframe& to,
                                                       double readout_time) {
  if (!from.frame->velocity || !to.frame->velocity) return std::nullopt;
  const std::vector<PointPair> pairs = MatchKeyframes(from, to);
  if (pairs.size() < kMinPoints) return std::nullopt;
  PairProblem problem(*from.frame, *to.frame, pairs);
  State state{to.cam_from_world * from.cam_from_world.Inverse(), readout_time};
  const double common_error = CommonError(to.frame->camera);
  double information = 0.0;
  for (int i = 0; i < kIterations; ++i) {
    NormalEquations equations = problem.Linearize(state, i >= kRobustIterations);
    information = equations.TimeInformation(common_error * common_error);
    equations.matrix(6, 6) += kDamping;
    const Vector7 step = -equations.matrix.ldlt().solve(equations.gradient);
    if (!step.allFinite()) return std::nullopt;
    state.relative_pose = Rigid3(ExpSO3(step.head<3>()), step.segment<3>(3)) * state.relative_pose;
    state.readout_time += step(6);
  }
  return ReadoutTimeEstimate{state.readout_time, information};
}

}  // namespace msc_vo
