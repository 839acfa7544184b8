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
    lines_in_cam_.push_back(keyframes.at(o.keyframe)->cam_from_world * lines.at(o.line)->segment);
  }
}

std::optional<Eigen::Vector2d> WindowResiduals::PointPixel(size_t i) const {
  if (!IsInFront(points_in_cam_[i])) return std::nullopt;
  const WindowData::PointObservation& o = window_.point_observations[i];
  return (window_.camera.Project(points_in_cam_[i]) - o.pixel) / o.sigma;
}

std::optional<double> WindowResiduals::PointDepth(size_t i) const {
  const WindowData::PointObservation& o = window_.point_observations[i];
  if (!(o.inverse_depth > 0.0) || !IsInFront(points_in_cam_[i])) return std::nullopt;
  return (1.0 / points_in_cam_[i].z() - o.inverse_depth) / o.inverse_depth_sigma;
}

std::optional<Eigen::Vector2d> WindowResiduals::LinePixel(size_t i) const {
  const LineSegment3& in_cam = lines_in_cam_[i];
  if (!IsInFront(in_cam)) return std::nullopt;
  const WindowData::LineObservation& o = window_.line_observations[i];
  const LineReprojection reprojection =
      MakeLineReprojection(window_.camera, o.segment, o.sigma, in_cam);
  Eigen::Vector2d residual;
  reprojection.Residual(0, Eigen::Vector3d(in_cam.start), &residual[0]);
  reprojection.Residual(1, Eigen::Vector3d(in_cam.end), &residual[1]);
  return residual;
}

std::optional<double> WindowResiduals::LineDepth(size_t i) const {
  const WindowData::LineObservation& o = window_.line_observations[i];
  if (!o.has_depth || !IsInFront(lines_in_cam_[i])) return std::nullopt;
  return (LineInverseDepth(i) - o.depth.At(0.5)) / o.depth.SigmaAt(0.5);
}

double WindowResiduals::LineInverseDepth(size_t i) const {
  // Along the image of a line 1/z is linear.
  const LineSegment2& image = window_.line_observations[i].segment;
  const LineSegment3& in_cam = lines_in_cam_[i];
  const double start = image.Parameter(window_.camera.Project(in_cam.start));
  const double end = image.Parameter(window_.camera.Project(in_cam.end));
  const double share = (0.5 - start) / (end - start);
  return (1.0 - share) / in_cam.start.z() + share / in_cam.end.z();
}

}  // namespace msc_vo
