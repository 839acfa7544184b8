// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/structure/scene_axes.h"

#include <cmath>
#include <stdexcept>

#include "msc_vo/factors/inverse_depth_line.h"

namespace msc_vo {

namespace {

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

// Observation of a line's direction in one view. In the interpretation plane its uncertainty is
// that of depth; across the plane it is that of the image, ten times smaller.
ManhattanAxesData::Observation Observe(const Keyframe& keyframe, int feature, int axis) {
  const Frame& frame = *keyframe.frame;
  const LineFeature& line = frame.lines[feature];
  const Eigen::Quaterniond world_from_cam = keyframe.cam_from_world.rotation().conjugate();
  const Eigen::Vector3d normal =
      frame.camera.Ray(line.segment.start).cross(frame.camera.Ray(line.segment.end)).normalized();
  ManhattanAxesData::Observation observation;
  observation.axis = axis;
  observation.direction = world_from_cam * frame.LineInCamera(feature).Direction();
  observation.normal = world_from_cam * normal;
  observation.sigma = DirectionSigma(frame.camera, line.segment, *line.depth);
  observation.normal_sigma =
      InverseDepthLine(frame.camera, line.segment, *line.depth, line.sigma, 0.0).image_angle();
  return observation;
}

}  // namespace

bool SceneAxesOptions::IsValid(std::string* error) const {
  if (!(deviation > 0.0)) {
    *error = "axes.deviation must be positive (degrees)";
    return false;
  }
  return coarse.IsValid(error) && association.IsValid(error) && refinement.IsValid(error) &&
         estimator.IsValid(error);
}

std::optional<int> AxisOfLine(const SceneAxesOptions& options, const AxesEstimate& axes,
                              const LineLandmark& line) {
  return AssociateAxis(options.association, axes.world_from_axes,
                       std::hypot(axes.sigma, DegreesToRadians(options.deviation)),
                       {line.segment.Direction(), line.direction_sigma});
}

SceneAxes::SceneAxes(const SceneAxesOptions& options)
    : options_(options), estimator_(options.estimator) {
  std::string error;
  if (!options.IsValid(&error)) throw std::invalid_argument("SceneAxes: " + error);
}

void SceneAxes::Update(const Map& map, KeyframeId keyframe,
                       const std::vector<AxisEvidence>& normals) {
  if (!options_.enabled) return;
  if (estimator_.state() == AxesState::kNone) Search(map, keyframe, normals);
  if (estimator_.state() == AxesState::kNone) return;
  estimator_.Update(CountSupport(map));
  if (estimator_.RefinementDue()) Refine(map);
}

void SceneAxes::Search(const Map& map, KeyframeId id, const std::vector<AxisEvidence>& normals) {
  const Keyframe& keyframe = *map.FindKeyframe(id);
  const auto axes = FindCoarseAxes(options_.coarse, LineEvidence(*keyframe.frame), normals);
  if (axes) estimator_.Propose(keyframe.cam_from_world.rotation().conjugate() * axes->rotation);
}

std::optional<int> SceneAxes::AxisOf(const LineLandmark& line) const {
  if (estimator_.state() == AxesState::kNone) return std::nullopt;
  return AxisOfLine(options_, {estimator_.world_from_axes(), estimator_.sigma()}, line);
}

AxesSupport SceneAxes::CountSupport(const Map& map) const {
  AxesSupport support;
  support.num_keyframes = static_cast<int>(map.keyframes().size());
  for (const auto& [id, line] : map.lines()) {
    if (line.direction_sigma > DegreesToRadians(options_.association.max_sigma)) continue;
    ++support.num_lines;
    if (AxisOf(line)) ++support.num_axis_lines;
  }
  return support;
}

void SceneAxes::Refine(const Map& map) {
  ManhattanAxesData data;
  data.world_from_manhattan = estimator_.world_from_axes();
  for (const auto& [id, line] : map.lines()) {
    const std::optional<int> axis = AxisOf(line);
    if (!axis) continue;
    // The deviation of a line from its axis is common to its n observations; sqrt(n) makes their
    // sum count it once.
    const double deviation = DegreesToRadians(options_.deviation) *
                             std::sqrt(static_cast<double>(line.observations.size()));
    for (const Observation& observation : line.observations) {
      const Keyframe& keyframe = *map.FindKeyframe(observation.keyframe);
      if (!keyframe.frame->lines[observation.feature].depth) continue;
      data.observations.push_back(Observe(keyframe, observation.feature, *axis));
      data.observations.back().sigma = std::hypot(data.observations.back().sigma, deviation);
      data.observations.back().normal_sigma =
          std::hypot(data.observations.back().normal_sigma, deviation);
    }
  }
  const ManhattanAxesSummary summary = RefineManhattanAxes(options_.refinement, &data);
  if (summary.usable) {
    estimator_.Refine(data.world_from_manhattan, summary.covariance);
  } else {
    estimator_.RejectRefinement();
  }
}

void SceneAxes::AddAlignments(const Map& map, WindowData* window) const {
  if (estimator_.state() == AxesState::kNone) return;
  const Eigen::Matrix3d axes = estimator_.world_from_axes().toRotationMatrix();
  for (const WindowData::Line& line : window->lines) {
    const std::optional<int> axis = AxisOf(*map.FindLine(line.id));
    if (!axis) continue;
    window->axis_alignments.push_back(
        {line.id, axes.col(*axis),
         std::hypot(estimator_.sigma(), DegreesToRadians(options_.deviation)), false});
  }
}

}  // namespace msc_vo
