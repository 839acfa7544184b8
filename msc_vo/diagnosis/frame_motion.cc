// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/diagnosis/frame_motion.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

#include "msc_vo/diagnosis/quantile.h"
#include "msc_vo/geometry/so3.h"
#include "msc_vo/matching/point_matcher.h"

namespace msc_vo {

namespace {

constexpr size_t kMinPoints = 25;
constexpr int kIterations = 15;
// Errors are compared with this multiple of their median, but not less than kMinScale pixels.
constexpr double kMinScale = 0.5;
// Inliers are within this many scales.
constexpr double kMaxScales = 3.0;
constexpr double kMinInlierRatio = 0.35;

// Reprojection error of a pair, pixels; infinite behind the camera.
struct Reprojection {
  Eigen::Vector2d error = Eigen::Vector2d::Constant(1e6);
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  // in the second camera, metres
};

Reprojection Reproject(const PinholeCamera& camera, const PointPair& pair, const Rigid3& motion) {
  Reprojection result;
  result.point = motion * camera.BackProject(pair.from.pixel, 1.0 / pair.from.inverse_depth);
  if (result.point.z() > 0.05) result.error = camera.Project(result.point) - pair.to.pixel;
  return result;
}

// One step of iteratively reweighted least squares with the weights of a Cauchy loss.
void Step(const PinholeCamera& camera, const std::vector<PointPair>& pairs, double scale,
          Rigid3* motion) {
  Eigen::Matrix<double, 6, 6> matrix = 1e-6 * Eigen::Matrix<double, 6, 6>::Identity();
  Eigen::Matrix<double, 6, 1> gradient = Eigen::Matrix<double, 6, 1>::Zero();
  for (const PointPair& pair : pairs) {
    const Reprojection r = Reproject(camera, pair, *motion);
    if (r.point.z() <= 0.05) continue;
    const double z = 1.0 / r.point.z();
    Eigen::Matrix<double, 2, 3> projection;
    projection << camera.fx * z, 0.0, -camera.fx * r.point.x() * z * z, 0.0, camera.fy * z,
        -camera.fy * r.point.y() * z * z;
    Eigen::Matrix<double, 2, 6> jacobian;
    jacobian.leftCols<3>() = -projection * Skew(r.point);
    jacobian.rightCols<3>() = projection;
    const double weight = 1.0 / (1.0 + r.error.squaredNorm() / (scale * scale));
    matrix += weight * jacobian.transpose() * jacobian;
    gradient += weight * jacobian.transpose() * r.error;
  }
  const Eigen::Matrix<double, 6, 1> step = -matrix.ldlt().solve(gradient);
  if (!step.allFinite()) return;
  *motion = Rigid3(ExpSO3(step.head<3>()), step.tail<3>()) * *motion;
}

double MedianError(const PinholeCamera& camera, const std::vector<PointPair>& pairs,
                   const Rigid3& motion) {
  std::vector<double> errors;
  errors.reserve(pairs.size());
  for (const PointPair& pair : pairs) {
    errors.push_back(Reproject(camera, pair, motion).error.norm());
  }
  return Median(std::move(errors));
}

}  // namespace

std::optional<FrameMotion> EstimateFrameMotion(const Frame& from, const Frame& to,
                                               const Rigid3& guess, double radius) {
  std::vector<PointPair> pairs;
  for (const PointMatch& match : MatchFrames(from, Rigid3(), to, guess, radius)) {
    pairs.push_back({from.points[match.id], to.points[match.feature]});
  }
  if (pairs.size() < kMinPoints) return std::nullopt;
  FrameMotion motion;
  motion.to_from_from = guess;
  for (int i = 0; i < kIterations; ++i) {
    const double scale = std::max(kMinScale, MedianError(to.camera, pairs, motion.to_from_from));
    Step(to.camera, pairs, scale, &motion.to_from_from);
  }
  motion.median_error = MedianError(to.camera, pairs, motion.to_from_from);
  const double limit = kMaxScales * std::max(kMinScale, motion.median_error);
  for (const PointPair& pair : pairs) {
    if (Reproject(to.camera, pair, motion.to_from_from).error.norm() < limit) {
      motion.points.push_back(pair);
    }
  }
  const bool agree = motion.points.size() >= kMinPoints &&
                     static_cast<double>(motion.points.size()) >=
                         kMinInlierRatio * static_cast<double>(pairs.size()) &&
                     motion.median_error < 0.25 * radius;
  if (!agree) return std::nullopt;
  motion.median_error = MedianError(to.camera, motion.points, motion.to_from_from);
  return motion;
}

}  // namespace msc_vo
