// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/mapping/readout_pair.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Cholesky>

#include "msc_vo/geometry/so3.h"
#include "msc_vo/map/rolling_shutter.h"

namespace msc_vo {

namespace {

using Matrix23 = Eigen::Matrix<double, 2, 3>;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Vector7 = Eigen::Matrix<double, 7, 1>;
using Matrix7 = Eigen::Matrix<double, 7, 7>;

// Four would do for seven unknowns; more, so that wrong ones do not decide.
constexpr int kMinPoints = 30;
constexpr int kIterations = 3;
// Square root of the 95 % chi-square quantile with two degrees of freedom.
constexpr double kHuber = 2.448;
// Pixels that all residuals may be off by alike, as they follow the row: by what depth, lens and
// velocity are off. Half the sigma of a point. With 0.15 the time is known sooner, but a corridor
// with a global shutter was taken for a rolling one.
constexpr double kCommonError = 0.25;
// 1/seconds^2: keeps the time where it is if nothing depends on it.
constexpr double kDamping = 1.0;

struct PointPair {
  const PointFeature* from;
  const PointFeature* to;
};

std::vector<PointPair> CommonPoints(const Map& map, const Keyframe& from, const Keyframe& to) {
  std::vector<PointPair> pairs;
  for (size_t i = 0; i < to.points.size(); ++i) {
    if (to.points[i] == kNoId) continue;
    const auto& observations = map.FindPoint(to.points[i])->observations;
    const auto seen = std::find_if(observations.begin(), observations.end(),
                                   [&from](const Observation& o) { return o.keyframe == from.id; });
    if (seen == observations.end()) continue;
    const PointFeature& point = from.frame->points[seen->feature];
    if (point.HasDepth()) pairs.push_back({&point, &to.frame->points[i]});
  }
  return pairs;
}

// Of the pixel of a ray with the ray.
Matrix23 ProjectionJacobian(const PinholeCamera& camera, const Eigen::Vector3d& ray) {
  const double scale = 1.0 / ray.z();
  Matrix23 jacobian;
  jacobian << camera.fx * scale, 0.0, -camera.fx * ray.x() * scale * scale,  //
      0.0, camera.fy * scale, -camera.fy * ray.y() * scale * scale;
  return jacobian;
}

struct NormalEquations {
  Matrix7 matrix = Matrix7::Zero();
  Vector7 gradient = Vector7::Zero();
  double weight = 0.0;  // sum over the points, 1/pixels^2

  // Of the time, if the pose is not known otherwise.
  double TimeInformation() const {
    const Vector6 coupling = matrix.col(6).head<6>();
    const Vector6 explained = matrix.topLeftCorner<6, 6>().ldlt().solve(coupling);
    return std::max(0.0, matrix(6, 6) - coupling.dot(explained));
  }
};

// Unknowns: rotation and translation of `motion`, from the left, and the readout time.
class PairProblem {
 public:
  PairProblem(const Frame& from, const Frame& to, const std::vector<PointPair>& pairs)
      : from_(from), to_(to), pairs_(pairs) {}

  NormalEquations Linearize(const Rigid3& motion, double readout_time) const {
    NormalEquations equations;
    for (const PointPair& pair : pairs_) Add(motion, readout_time, pair, &equations);
    return equations;
  }

 private:
  void Add(const Rigid3& motion, double readout_time, const PointPair& pair,
           NormalEquations* equations) const {
    const PinholeCamera& camera = to_.camera;
    const PointFeature& a = *pair.from;
    const PointFeature& b = *pair.to;
    const double b_inverse_depth = b.HasDepth() ? b.inverse_depth : a.inverse_depth;
    const Eigen::Vector3d a_change = RayChange(from_, a.pixel, a.inverse_depth);
    const Eigen::Vector3d b_change = RayChange(to_, b.pixel, b_inverse_depth);
    const Eigen::Vector3d a_ray =
        camera.Ray(a.pixel) + (readout_time - from_.readout_time) * a_change;
    const Eigen::Vector3d b_ray =
        camera.Ray(b.pixel) + (readout_time - to_.readout_time) * b_change;
    const Eigen::Vector3d moved =
        motion.rotation() * a_ray + a.inverse_depth * motion.translation();
    const Eigen::Vector2d residual = camera.Project(moved) - camera.Project(b_ray);

    const Matrix23 projection = ProjectionJacobian(camera, moved);
    Eigen::Matrix<double, 2, 7> jacobian;
    jacobian.leftCols<3>() = -projection * Skew(moved);
    jacobian.middleCols<3>(3) = a.inverse_depth * projection;
    jacobian.col(6) =
        projection * (motion.rotation() * a_change) - ProjectionJacobian(camera, b_ray) * b_change;
    const double variance = a.sigma * a.sigma + b.sigma * b.sigma;
    const double sigmas = residual.norm() / std::sqrt(variance);
    const double weight = std::min(1.0, kHuber / std::max(sigmas, kHuber)) / variance;
    equations->matrix += weight * jacobian.transpose() * jacobian;
    equations->gradient += weight * jacobian.transpose() * residual;
    equations->weight += weight;
  }

  const Frame& from_;
  const Frame& to_;
  const std::vector<PointPair>& pairs_;
};

}  // namespace

std::optional<ReadoutEstimate> EstimateReadout(const Map& map, const Keyframe& from,
                                               const Keyframe& to, double readout_time) {
  const std::vector<PointPair> pairs = CommonPoints(map, from, to);
  if (pairs.size() < kMinPoints || !from.frame->velocity || !to.frame->velocity) return {};
  const PairProblem problem(*from.frame, *to.frame, pairs);
  Rigid3 motion = to.cam_from_world * from.cam_from_world.Inverse();
  ReadoutEstimate estimate{readout_time, 0.0};
  for (int i = 0; i < kIterations; ++i) {
    NormalEquations equations = problem.Linearize(motion, estimate.readout_time);
    // A common error of so many pixels is as good as one point of that sigma.
    estimate.information =
        equations.TimeInformation() / (1.0 + kCommonError * kCommonError * equations.weight);
    equations.matrix(6, 6) += kDamping;
    const Vector7 step = -equations.matrix.ldlt().solve(equations.gradient);
    if (!step.allFinite()) return {};
    motion = Rigid3(ExpSO3(step.head<3>()), step.segment<3>(3)) * motion;
    estimate.readout_time += step(6);
  }
  return estimate;
}

}  // namespace msc_vo
