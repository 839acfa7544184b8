// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/structure/direction_estimate.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "msc_vo/bundle_adjustment/observation.h"

namespace msc_vo {

namespace {

using Basis = Eigen::Matrix<double, 3, 2>;

// Least squares for a small change of a direction, in the plane perpendicular to it.
class DirectionFit {
 public:
  explicit DirectionFit(const Eigen::Vector3d& direction) : direction_(direction) {
    basis_.col(0) = direction.unitOrthogonal();
    basis_.col(1) = direction.cross(basis_.col(0));
  }

  // `normal` . direction = 0 with standard deviation `sigma`, radians.
  void AddNormal(const Eigen::Vector3d& normal, double sigma) {
    const Eigen::Vector2d row = basis_.transpose() * normal / sigma;
    information_ += row * row.transpose();
    gradient_ += row * (normal.dot(direction_) / sigma);
  }

  std::optional<DirectionEstimate> Solve() const {
    const Eigen::LLT<Eigen::Matrix2d> llt(information_);
    // A radian of standard deviation: not determined.
    if (llt.info() != Eigen::Success || !(information_.determinant() > information_.trace())) {
      return std::nullopt;
    }
    const Eigen::Vector2d change = -llt.solve(gradient_);
    const Eigen::Vector3d direction = (direction_ + basis_ * change).normalized();
    const Eigen::Matrix3d covariance =
        basis_ * llt.solve(Eigen::Matrix2d::Identity()) * basis_.transpose();
    // The covariance has no component along the direction.
    const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - direction * direction.transpose();
    return DirectionEstimate{direction, across * covariance * across};
  }

 private:
  Eigen::Vector3d direction_;
  Basis basis_;
  Eigen::Matrix2d information_ = Eigen::Matrix2d::Zero();
  Eigen::Vector2d gradient_ = Eigen::Vector2d::Zero();
};

// Standard deviation (radians) of the tilt of the interpretation plane about the perpendicular of
// the line, by image noise. `depths`: inverse depths of the end points.
double PlaneSigma(const PinholeCamera& camera, const LineSegment2& segment,
                  const Eigen::Vector3d& normal, const Eigen::Vector2d& depths, double sigma) {
  const Eigen::Vector3d u =
      depths[0] * camera.Ray(segment.end) - depths[1] * camera.Ray(segment.start);
  const Eigen::Vector2d d = segment.Direction();
  const double pixel = std::abs(normal.x() * -d.y() / camera.fx + normal.y() * d.x() / camera.fy);
  return sigma * pixel * depths.norm() / u.norm();
}

void AddObservation(const WindowData& window, const WindowData::LineObservation& observation,
                    const Rigid3& cam_from_world, const WindowData::Line& line, DirectionFit* fit) {
  const LineSegment3 in_cam = cam_from_world * line.segment;
  const auto start = InverseDepthAt(window.camera, observation.segment, in_cam, 0.0);
  const auto end = InverseDepthAt(window.camera, observation.segment, in_cam, 1.0);
  if (!start || !end) return;
  const Eigen::Quaterniond world_from_cam = cam_from_world.rotation().conjugate();
  const Eigen::Vector3d normal = window.camera.Ray(observation.segment.start)
                                     .cross(window.camera.Ray(observation.segment.end))
                                     .normalized();
  fit->AddNormal(world_from_cam * normal,
                 PlaneSigma(window.camera, observation.segment, normal, {*start, *end},
                            line.noise * observation.sigma));
  if (!observation.has_depth) return;
  const LineDepth depth = Nearer(observation.depth, line.depth_offset);
  const Eigen::Vector3d measured =
      BackProject(window.camera, observation.segment, depth).Direction();
  fit->AddNormal(world_from_cam * normal.cross(measured),
                 line.noise * DirectionSigma(window.camera, observation.segment, depth));
}

}  // namespace

double DirectionEstimate::Sigma() const {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(covariance, Eigen::EigenvaluesOnly);
  return std::sqrt(std::max(0.0, eigen.eigenvalues()[2]));
}

std::vector<std::optional<DirectionEstimate>> EstimateDirections(const WindowData& window) {
  std::unordered_map<int64_t, const Rigid3*> poses;
  for (const WindowData::Keyframe& keyframe : window.keyframes) {
    poses[keyframe.id] = &keyframe.cam_from_world;
  }
  std::unordered_map<int64_t, size_t> index;
  std::vector<DirectionFit> fits;
  for (const WindowData::Line& line : window.lines) {
    index[line.id] = fits.size();
    fits.emplace_back(line.segment.Direction());
  }
  // Rejected observations count as well. Chosen by measurement, see docs/lab/structure.md.
  for (const WindowData::LineObservation& observation : window.line_observations) {
    const size_t i = index.at(observation.line);
    AddObservation(window, observation, *poses.at(observation.keyframe), window.lines[i], &fits[i]);
  }
  std::vector<std::optional<DirectionEstimate>> estimates;
  for (const DirectionFit& fit : fits) estimates.push_back(fit.Solve());
  return estimates;
}

}  // namespace msc_vo
