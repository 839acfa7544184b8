// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/mapping/window_residuals.h"

#include <cstdint>
#include <unordered_map>

#include "msc_vo/problems/observation.h"

namespace msc_vo {

namespace {

// For look-ups alone: nothing depends on the order inside.
template <typename Item>
std::unordered_map<int64_t, const Item*> ById(const std::vector<Item>& items) {
  std::unordered_map<int64_t, const Item*> by_id;
  by_id.reserve(items.size());
  for (const Item& item : items) by_id[item.id] = &item;
  return by_id;
}

}  // namespace

WindowResiduals::WindowResiduals(const WindowData& solved) : window_(solved) {
  const auto keyframes = ById(solved.keyframes);
  const auto points = ById(solved.points);
  const auto lines = ById(solved.lines);
  points_in_cam_.reserve(solved.point_observations.size());
  for (const WindowData::PointObservation& o : solved.point_observations) {
    points_in_cam_.push_back(keyframes.at(o.keyframe)->cam_from_world *
                             points.at(o.point)->position);
  }
  lines_in_cam_.reserve(solved.line_observations.size());
  for (const WindowData::LineObservation& o : solved.line_observations) {
    const WindowData::Line& line = *lines.at(o.line);
    lines_in_cam_.push_back(keyframes.at(o.keyframe)->cam_from_world * line.segment);
    depth_offsets_.push_back(line.depth_offset);
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
  const double inverse_depth = InverseDepthAt(window_.camera, o.segment, lines_in_cam_[i], 0.5);
  return (inverse_depth - Nearer(o.depth, depth_offsets_[i]).At(0.5)) / o.depth.SigmaAt(0.5);
}

}  // namespace msc_vo
