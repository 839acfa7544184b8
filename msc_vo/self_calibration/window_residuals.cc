// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/self_calibration/window_residuals.h"

#include <cstdint>
#include <unordered_map>

#include "msc_vo/bundle_adjustment/observation.h"

namespace msc_vo {

namespace {

// Index of each item by its id. Used for look-ups only, because the order is unspecified.
template <typename Item>
std::unordered_map<int64_t, int> IndexById(const std::vector<Item>& items) {
  std::unordered_map<int64_t, int> indices;
  indices.reserve(items.size());
  for (size_t i = 0; i < items.size(); ++i) indices[items[i].id] = static_cast<int>(i);
  return indices;
}

}  // namespace

WindowResiduals::WindowResiduals(const WindowData& optimized) : window_(optimized) {
  const auto keyframes = IndexById(optimized.keyframes);
  const auto points = IndexById(optimized.points);
  const auto lines = IndexById(optimized.lines);
  points_in_cam_.reserve(optimized.point_observations.size());
  points_.reserve(optimized.point_observations.size());
  for (const WindowData::PointObservation& o : optimized.point_observations) {
    points_.push_back(points.at(o.point));
    points_in_cam_.push_back(optimized.keyframes[keyframes.at(o.keyframe)].cam_from_world *
                             optimized.points[points_.back()].position);
  }
  lines_in_cam_.reserve(optimized.line_observations.size());
  lines_.reserve(optimized.line_observations.size());
  for (const WindowData::LineObservation& o : optimized.line_observations) {
    lines_.push_back(lines.at(o.line));
    const LineSegment3 in_cam = optimized.keyframes[keyframes.at(o.keyframe)].cam_from_world *
                                optimized.lines[lines_.back()].segment;
    const LinePart part = ObservedPart(optimized.camera, o.segment, in_cam).value_or(LinePart());
    lines_in_cam_.push_back(part.Of(in_cam));
  }
}

std::optional<double> WindowResiduals::PointDepth(size_t i) const {
  const WindowData::PointObservation& o = window_.point_observations[i];
  if (!(o.inverse_depth > 0.0) || !IsInFront(points_in_cam_[i])) return std::nullopt;
  return (1.0 / points_in_cam_[i].z() - o.inverse_depth) / o.inverse_depth_sigma;
}

std::optional<Eigen::Vector2d> WindowResiduals::LinePixel(size_t i) const {
  if (!IsInFront(lines_in_cam_[i])) return std::nullopt;
  const WindowData::LineObservation& o = window_.line_observations[i];
  return LineResidual(window_.camera, o.segment, o.sigma, lines_in_cam_[i]);
}

std::optional<double> WindowResiduals::LineDepth(size_t i) const {
  const WindowData::LineObservation& o = window_.line_observations[i];
  if (!o.has_depth || !IsInFront(lines_in_cam_[i])) return std::nullopt;
  const std::optional<double> inverse_depth =
      InverseDepthAt(window_.camera, o.segment, lines_in_cam_[i], 0.5);
  if (!inverse_depth) return std::nullopt;
  return (*inverse_depth - Nearer(o.depth, window_.lines[lines_[i]].depth_offset).At(0.5)) /
         o.depth.SigmaAt(0.5);
}

}  // namespace msc_vo
