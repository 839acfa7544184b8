// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/map/path_covariance.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>
#include <utility>

#include <Eigen/Cholesky>

#include "msc_vo/factors/chi_square.h"
#include "msc_vo/geometry/angles.h"
#include "msc_vo/geometry/so3.h"

namespace msc_vo {

namespace {

// Variance of a step relative to that of the pose, which holds the landmarks for exact: they err as
// well, and neighbours share their errors, so that those of the steps add up faster.
constexpr double kStepScale = 4.0;
// What errors of the calibration and of the depth sensor add, which are the same in every step. All
// are measured, see docs/lab/loops.md.
// Per metre of the path:
constexpr double kSystematicSigma = 0.005;                           // metres
constexpr double kSystematicRotationSigma = DegreesToRadians(0.05);  // radians
// Ratio of the turn: a wrong focal length errs by a ratio of each angle.
constexpr double kTurnSigma = 0.005;
// Where the surfaces are, metres: a motion across the view looks like a turn about its surface.
constexpr double kViewDistance = 2.5;

}  // namespace

PoseCovariance SystematicCovariance(double length, double turn) {
  return IsotropicCovariance(std::hypot(kSystematicRotationSigma * length, kTurnSigma * turn),
                             kSystematicSigma * length);
}

void PathDrift::AddStep(const Rigid3& base_from_begin, const Rigid3& base_from_end,
                        const PoseCovariance& covariance) {
  const Eigen::Vector3d &begin = base_from_begin.translation(), &end = base_from_end.translation();
  const Eigen::Quaterniond rotation =
      base_from_end.rotation() * base_from_begin.rotation().conjugate();
  const Eigen::Vector3d turn = LogSO3(rotation);
  steps_ += kStepScale * covariance;
  length_ += (end - begin).norm();
  turn_ += turn;
  lever_ += 0.5 * (begin + end) * turn.transpose();
  view_change_ += base_from_end.rotation() * Eigen::Vector3d::UnitZ() -
                  base_from_begin.rotation() * Eigen::Vector3d::UnitZ();
}

// The rotation vector w of a step at the place p errs by E w, with a matrix E whose entries are
// independent and the same in all steps: column j of E is a rotation by the sum of w_j, with the
// lever of the sum of w_j p.
PoseCovariance PathDrift::TurnCovariance() const {
  PoseCovariance covariance;
  covariance.topLeftCorner<3, 3>() = turn_.squaredNorm() * Eigen::Matrix3d::Identity();
  covariance.bottomLeftCorner<3, 3>() = Skew(lever_ * turn_);
  covariance.topRightCorner<3, 3>() = covariance.bottomLeftCorner<3, 3>().transpose();
  covariance.bottomRightCorner<3, 3>() =
      lever_.squaredNorm() * Eigen::Matrix3d::Identity() - lever_ * lever_.transpose();
  return kTurnSigma * kTurnSigma * covariance;
}

PoseCovariance PathDrift::At(const Rigid3& cam_from_base, double factor) const {
  const PoseCovariance systematic =
      SystematicCovariance(length_, 0.0) + TransportCovariance(cam_from_base, TurnCovariance()) +
      IsotropicCovariance(0.0, kTurnSigma * kViewDistance * view_change_.norm());
  return StepsAt(cam_from_base) + factor * factor * systematic;
}

double PathDrift::Trace() const {
  return steps_.trace() + SystematicCovariance(length_, 0.0).trace();
}

PathDrift DriftBetween(const Map& map, KeyframeId a, KeyframeId b) {
  const Rigid3 b_from_world = map.CamFromWorld(b);
  const KeyframeId first = std::min(a, b), last = std::max(a, b);
  Rigid3 b_from_begin = b_from_world * map.CamFromWorld(first).Inverse();
  PathDrift drift;
  for (KeyframeId id = first + 1; id <= last; ++id) {
    const PoseCovariance* step = map.StepCovariance(id);
    if (step == nullptr) continue;
    const Rigid3 b_from_end = b_from_world * map.CamFromWorld(id).Inverse();
    drift.AddStep(b_from_begin, b_from_end, TransportCovariance(b_from_end, *step));
    b_from_begin = b_from_end;
  }
  return drift;
}

PathCovariances::PathCovariances(const Map& map, const std::vector<PoseGraphEdge>& loops,
                                 KeyframeId root) {
  const Rigid3 root_from_world = map.CamFromWorld(root);
  for (const KeyframeId id : map.KnownKeyframes()) {
    nodes_.push_back({id, root_from_world * map.CamFromWorld(id).Inverse(), {}});
  }
  FindPaths(EdgesOf(map, loops), Find(root) - nodes_.data());
}

const PathCovariances::Node* PathCovariances::Find(KeyframeId keyframe) const {
  const auto place = std::lower_bound(nodes_.begin(), nodes_.end(), keyframe,
                                      [](const Node& node, KeyframeId id) { return node.id < id; });
  return place != nodes_.end() && place->id == keyframe ? &*place : nullptr;
}

std::vector<PathCovariances::Edge> PathCovariances::EdgesOf(
    const Map& map, const std::vector<PoseGraphEdge>& loops) const {
  std::vector<Edge> edges;
  for (size_t i = 1; i < nodes_.size(); ++i) {
    edges.push_back(
        {i - 1, i,
         TransportCovariance(nodes_[i].root_from_cam, *map.StepCovariance(nodes_[i].id))});
  }
  for (const PoseGraphEdge& loop : loops) {
    const Node *from = Find(loop.from), *to = Find(loop.to);
    if (from == nullptr || to == nullptr) continue;
    edges.push_back({static_cast<size_t>(from - nodes_.data()),
                     static_cast<size_t>(to - nodes_.data()),
                     TransportCovariance(to->root_from_cam,
                                         CameraCovariance(loop.to_from_from, loop.covariance))});
  }
  return edges;
}

// Dijkstra's algorithm. The systematic part grows with the square of the length, so that the path
// is not always the best one; the covariance is that of the path.
void PathCovariances::FindPaths(const std::vector<Edge>& edges, size_t root) {
  std::vector<std::vector<const Edge*>> edges_of(nodes_.size());
  for (const Edge& edge : edges) {
    edges_of[edge.from].push_back(&edge);
    edges_of[edge.to].push_back(&edge);
  }
  using Entry = std::pair<double, size_t>;  // cost, node
  std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> open;
  nodes_[root].cost = 0.0;
  open.push({0.0, root});
  while (!open.empty()) {
    const auto [cost, index] = open.top();
    open.pop();
    if (cost > nodes_[index].cost) continue;  // found on a better path since
    for (const Edge* edge : edges_of[index]) {
      Node& next = nodes_[edge->from == index ? edge->to : edge->from];
      if (next.cost <= cost) continue;  // its path is final
      PathDrift drift = nodes_[index].drift;
      drift.AddStep(nodes_[index].root_from_cam, next.root_from_cam, edge->covariance);
      const double next_cost = drift.Trace();
      if (next_cost >= next.cost) continue;
      next.drift = drift;
      next.cost = next_cost;
      open.push({next_cost, static_cast<size_t>(&next - nodes_.data())});
    }
  }
}

PoseCovariance PathCovariances::Of(KeyframeId keyframe, const Rigid3& cam_from_keyframe,
                                   const PoseCovariance& step) const {
  const Node* node = Find(keyframe);
  const Rigid3 root_from_cam = node->root_from_cam * cam_from_keyframe.Inverse();
  PathDrift drift = node->drift;
  drift.AddStep(node->root_from_cam, root_from_cam, TransportCovariance(root_from_cam, step));
  return drift.At(root_from_cam.Inverse());
}

PoseCovariance PathCovariances::OfRoot(KeyframeId keyframe) const {
  return Find(keyframe)->drift.At(Rigid3());
}

double SquaredDriftError(const Rigid3& by_path, const Rigid3& measured,
                         const PoseCovariance& covariance) {
  const Rigid3 error = by_path * measured.Inverse();
  Eigen::Matrix<double, 6, 1> tangent;
  tangent << LogSO3(error.rotation()), error.translation();
  return tangent.dot(covariance.ldlt().solve(tangent));
}

bool IsPossibleDrift(const Rigid3& by_path, const Rigid3& measured,
                     const PoseCovariance& covariance) {
  return SquaredDriftError(by_path, measured, covariance) < kOutlierChiSquare[6];
}

}  // namespace msc_vo
