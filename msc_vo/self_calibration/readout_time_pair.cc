// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/self_calibration/readout_time_pair.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "msc_vo/factors/camera_factor.h"
#include "msc_vo/factors/robust_loss.h"
#include "msc_vo/geometry/so3.h"
#include "msc_vo/map/rolling_shutter.h"
#include "msc_vo/matching/point_matcher.h"

namespace msc_vo {

namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Vector7 = Eigen::Matrix<double, 7, 1>;
using Matrix7 = Eigen::Matrix<double, 7, 7>;

// Four would do for seven unknowns; more, so that wrong ones do not decide.
constexpr int kMinPoints = 30;
// Pixels. The last row of an image that turns by a radian per second is off by 7 of them after half
// of 26 ms, and two images may turn in opposite ways. What is matched must not depend on what is to
// be found: the inliers of poses that know of no shutter say 10 ms where 26 are true.
constexpr double kSearchRadius = 20.0;
// Three robust iterations find the points that agree, two take those alone.
constexpr int kRobustIterations = 3;
constexpr int kIterations = 5;
// Square roots of the 95 % and 99 % chi-square quantiles with two degrees of freedom, and the
// median.
constexpr HuberLoss kLoss{2.448};
constexpr double kCut = 3.035;
constexpr double kMedian = 1.177;
// Pixels that all residuals may be off by alike, as they follow the row: by what depth, lens and
// velocity are off. Less than half the sigma of a point. With 0.15 a shutter is known to roll some
// keyframes sooner, but the odds of a corridor's global one came to 60.
constexpr double kCommonError = 0.2;
// 1/seconds^2: keeps the time where it is if nothing depends on it.
constexpr double kDamping = 1.0;

struct PointPair {
  const PointFeature* from;
  const PointFeature* to;
};

// The points of `from` that have a depth, where they are found again in `to` by their descriptors.
std::vector<PointPair> MatchFrames(const Keyframe& from, const Keyframe& to) {
  const Rigid3 world_from_cam = from.cam_from_world.Inverse();
  std::vector<PointCandidate> candidates;
  for (size_t i = 0; i < from.frame->points.size(); ++i) {
    const PointFeature& point = from.frame->points[i];
    if (!point.HasDepth()) continue;
    PointCandidate candidate;
    candidate.id = static_cast<LandmarkId>(i);
    candidate.position = world_from_cam * from.frame->PointInCamera(static_cast<int>(i));
    candidate.descriptor = point.descriptor;
    candidate.level = point.level;
    if (ProjectCandidate(to.frame->camera, to.cam_from_world, &candidate)) {
      candidates.push_back(candidate);
    }
  }
  std::vector<PointPair> pairs;
  for (const PointMatch& match : MatchPoints({}, *to.frame, candidates, kSearchRadius, {})) {
    pairs.push_back({&from.frame->points[match.id], &to.frame->points[match.feature]});
  }
  return pairs;
}

// Rigid motion from the one camera to the other, and the readout time of both.
struct State {
  Rigid3 motion;
  double readout_time = 0.0;  // seconds
};

// A point pair at a state. Unknowns: rotation and translation of the motion, from the left, and the
// readout time.
struct Residual {
  Eigen::Vector2d value;                 // pixels
  Eigen::Matrix<double, 2, 7> jacobian;  // of the value
  Eigen::Matrix2d information;           // 1/pixels^2

  double Sigmas() const { return std::sqrt(value.dot(information * value)); }
};

// The sum over the points of a pair of frames.
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

  // Of the time, if the pose is not known otherwise. A common error of so many pixels is as good as
  // one point of that sigma.
  double TimeInformation() const {
    const Vector6 coupling = matrix.col(6).head<6>();
    const Vector6 explained = matrix.topLeftCorner<6, 6>().ldlt().solve(coupling);
    const double random = std::max(0.0, matrix(6, 6) - coupling.dot(explained));
    return random / (1.0 + kCommonError * kCommonError * weight);
  }
};

class PairProblem {
 public:
  PairProblem(const Frame& from, const Frame& to, const std::vector<PointPair>& pairs)
      : from_(from), to_(to), pairs_(pairs), residuals_(pairs.size()) {}

  // Residuals in sigmas are measured by their median, as blur and wrong velocities make all of them
  // larger. With `cut`, those that do not agree are left out, else they weigh less.
  NormalEquations Linearize(const State& state, bool cut) {
    for (size_t i = 0; i < pairs_.size(); ++i) residuals_[i] = ResidualOf(pairs_[i], state);
    const double scale = std::max(1.0, MedianSigmas() / kMedian);
    NormalEquations equations;
    for (const Residual& residual : residuals_) {
      const double sigmas = residual.Sigmas() / scale;
      if (cut && sigmas > kCut) continue;
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
    const Eigen::Vector3d moved =
        state.motion.rotation() * a_ray + a.inverse_depth * state.motion.translation();

    Residual residual;
    residual.value = camera.Project(moved) - camera.Project(b_ray);
    const Eigen::Matrix<double, 2, 3> projection = ProjectionJacobian(camera, moved);
    residual.jacobian.leftCols<3>() = -projection * Skew(moved);
    residual.jacobian.middleCols<3>(3) = a.inverse_depth * projection;
    residual.jacobian.col(6) = projection * (state.motion.rotation() * a_change) -
                               ProjectionJacobian(camera, b_ray) * b_change;
    const Eigen::Vector2d depth_error =
        a.inverse_depth_sigma * (projection * state.motion.translation());
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
    const auto middle = sigmas.begin() + static_cast<std::ptrdiff_t>(sigmas.size() / 2);
    std::nth_element(sigmas.begin(), middle, sigmas.end());
    return *middle;
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
  const std::vector<PointPair> pairs = MatchFrames(from, to);
  if (pairs.size() < kMinPoints) return std::nullopt;
  PairProblem problem(*from.frame, *to.frame, pairs);
  State state{to.cam_from_world * from.cam_from_world.Inverse(), readout_time};
  double information = 0.0;
  for (int i = 0; i < kIterations; ++i) {
    NormalEquations equations = problem.Linearize(state, i >= kRobustIterations);
    information = equations.TimeInformation();
    equations.matrix(6, 6) += kDamping;
    const Vector7 step = -equations.matrix.ldlt().solve(equations.gradient);
    if (!step.allFinite()) return std::nullopt;
    state.motion = Rigid3(ExpSO3(step.head<3>()), step.segment<3>(3)) * state.motion;
    state.readout_time += step(6);
  }
  return ReadoutTimeEstimate{state.readout_time, information};
}

}  // namespace msc_vo
