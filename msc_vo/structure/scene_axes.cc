// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/structure/scene_axes.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <Eigen/Eigenvalues>

#include "msc_vo/structure/internal/relation_mixture.h"

namespace msc_vo {

namespace {

// Largest angle between an axis and an uncertain line, and largest standard deviation of the line,
// radians. Measured in docs/lab/structure.md.
constexpr double kMaxUncertainAngle = DegreesToRadians(15.0);
// Smallest probability of a line near an axis not to be there by chance.
constexpr double kMinAxisProbability = 0.8;

// Directions of the frame's lines that have a depth, camera frame.
std::vector<AxisEvidence> LineEvidence(const Frame& frame) {
  std::vector<AxisEvidence> evidence;
  for (size_t i = 0; i < frame.lines.size(); ++i) {
    const LineFeature& line = frame.lines[i];
    if (!line.depth) continue;
    evidence.push_back({frame.LineInCamera(static_cast<int>(i)).Direction(),
                        DirectionSigma(frame.camera, line.segment, *line.depth)});
  }
  return evidence;
}

// The direction of a line as a measurement of its axis. The least certain component of a direction
// is that of depth, the other one that of the image.
ManhattanAxesData::Observation Observe(const DirectionEstimate& line, int axis, double deviation) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(line.covariance);
  const Eigen::Vector3d variances = eigen.eigenvalues().cwiseMax(0.0);
  ManhattanAxesData::Observation observation;
  observation.axis = axis;
  observation.direction = line.direction;
  observation.normal = eigen.eigenvectors().col(2).cross(line.direction).normalized();
  observation.sigma = std::hypot(std::sqrt(variances[2]), deviation);
  observation.normal_sigma = std::hypot(std::sqrt(variances[1]), deviation);
  return observation;
}

}  // namespace

std::optional<int> AxisOfLine(const AxesEstimate& axes, const LineLandmark& line) {
  return AssociateAxis(axes.world_from_axes, std::hypot(axes.sigma, axes.deviation),
                       {line.segment.Direction(), line.direction_sigma});
}

std::optional<int> AxisOfPlane(const AxesEstimate& axes, const Plane& plane) {
  // With this sigma, the largest angle alone decides.
  return AssociateAxis(axes.world_from_axes, 0.0, {plane.normal(), kMaxAxisAngle});
}

void SceneAxes::Restore(const AxesEstimate& axes) {
  restored_ = axes;
  if (options_.enabled) estimator_.Restore(axes.world_from_axes, axes.sigma);
}

void SceneAxes::Reset() {
  const std::optional<AxesEstimate> restored = restored_;
  *this = SceneAxes(options_);
  if (restored) Restore(*restored);
}

void SceneAxes::Update(const Map& map, KeyframeId keyframe,
                       const std::vector<AxisEvidence>& normals) {
  if (!options_.enabled) return;
  if (estimator_.state() == AxesState::kNone) Search(map, keyframe, normals);
  if (estimator_.state() == AxesState::kNone) return;
  estimator_.Update(CountSupport(map));
  if (estimator_.RefinementDue()) Refine();
}

void SceneAxes::Search(const Map& map, KeyframeId id, const std::vector<AxisEvidence>& normals) {
  const Keyframe& keyframe = *map.FindKeyframe(id);
  const auto axes = FindCoarseAxes(LineEvidence(*keyframe.frame), normals);
  if (axes) estimator_.Propose(keyframe.cam_from_world.rotation().conjugate() * axes->rotation);
}

void SceneAxes::Learn(const Map& map, const WindowData& window) {
  if (!options_.enabled) return;
  const std::vector<std::optional<DirectionEstimate>> estimates = EstimateDirections(window);
  std::vector<DirectionDeviation> deviations;
  for (size_t i = 0; i < estimates.size(); ++i) {
    if (!estimates[i]) continue;
    directions_[window.lines[i].id] = *estimates[i];
    if (estimator_.state() != AxesState::kRefined) continue;
    const std::optional<AxisCandidate> candidate = NearestAxis(*estimates[i]);
    if (candidate) deviations.push_back(candidate->deviation);
  }
  deviation_.Update(deviations);
  for (auto line = directions_.begin(); line != directions_.end();) {
    line =
        map.Find<LineLandmark>(line->first) != nullptr ? std::next(line) : directions_.erase(line);
  }
}

std::optional<AxesEstimate> SceneAxes::Estimate() const {
  if (estimator_.state() == AxesState::kNone) return std::nullopt;
  return AxesEstimate{estimator_.world_from_axes(), estimator_.sigma(), deviation_.scale()};
}

std::optional<int> SceneAxes::AxisOf(const LineLandmark& line) const {
  const std::optional<AxesEstimate> axes = Estimate();
  return axes ? AxisOfLine(*axes, line) : std::nullopt;
}

std::optional<AxisCandidate> SceneAxes::NearestAxis(const DirectionEstimate& line) const {
  return msc_vo::NearestAxis(kMaxAxisAngle, estimator_.world_from_axes().toRotationMatrix(),
                             estimator_.sigma(), line);
}

AxesSupport SceneAxes::CountSupport(const Map& map) const {
  AxesSupport support;
  support.num_keyframes = static_cast<int>(map.keyframes().size());
  for (const auto& [id, direction] : directions_) {
    if (direction.Sigma() > kMaxAxisAngle) continue;
    ++support.num_lines;
    if (NearestAxis(direction)) ++support.num_axis_lines;
  }
  return support;
}

void SceneAxes::Refine() {
  ManhattanAxesData data;
  data.world_from_manhattan = estimator_.world_from_axes();
  for (const auto& [id, direction] : directions_) {
    const std::optional<AxisCandidate> candidate = NearestAxis(direction);
    if (!candidate) continue;
    data.observations.push_back(
        Observe(direction, candidate->axis, deviation_.Sigma(candidate->deviation)));
  }
  const ManhattanAxesSummary summary = RefineManhattanAxes(&data);
  if (summary.usable) {
    estimator_.Refine(data.world_from_manhattan, summary.covariance);
  } else {
    estimator_.RejectRefinement();
  }
}

void SceneAxes::AddAllAlignments(WindowData* window) const {
  AddAlignments(kMaxUncertainAngle, window);
}

void SceneAxes::AddAlignments(double max_angle, WindowData* window) const {
  if (estimator_.state() != AxesState::kRefined) return;
  struct Candidate {
    size_t line;
    AxisCandidate near;
  };
  std::vector<Candidate> candidates;
  std::vector<double> densities;
  const Eigen::Matrix3d axes = estimator_.world_from_axes().toRotationMatrix();
  const std::vector<std::optional<DirectionEstimate>> estimates = EstimateDirections(*window);
  for (size_t i = 0; i < estimates.size(); ++i) {
    if (!estimates[i]) continue;
    const std::optional<AxisCandidate> near =
        msc_vo::NearestAxis(max_angle, axes, estimator_.sigma(), *estimates[i]);
    if (!near) continue;
    candidates.push_back({i, *near});
    densities.push_back(deviation_.Density(near->deviation));
  }
  const std::vector<double> probabilities =
      RelationProbabilities(densities, 1.0 / (kPi * max_angle * max_angle));
  for (size_t i = 0; i < candidates.size(); ++i) {
    const auto& [line, near] = candidates[i];
    if (probabilities[i] < kMinAxisProbability ||
        deviation_.ChiSquare(near.deviation) > kMaxAxisSigmas * kMaxAxisSigmas) {
      continue;
    }
    const double deviation = deviation_.Sigma(near.deviation) / std::sqrt(probabilities[i]);
    window->axis_alignments.push_back({window->lines[line].id, axes.col(near.axis),
                                       std::hypot(estimator_.sigma(), deviation), false});
  }
}

}  // namespace msc_vo
