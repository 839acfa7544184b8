// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/evaluation/line_error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace msc_vo {

namespace {

// Offset of a line from an edge.
struct Offset {
  double angle = 0.0;         // radians
  double angle_across = 0.0;  // radians, across the plane of edge and viewing direction
  double across = 0.0;        // metres, across that plane
  double along = 0.0;         // metres, in that plane
  double beyond = 0.0;        // metres, of the midpoint beyond the nearer end of the edge, or 0

  double Distance() const { return std::hypot(across, along); }
};

Offset ComputeOffset(const EstimatedLine& line, const LineSegment3& edge) {
  const Eigen::Vector3d midpoint = line.segment.Midpoint();
  const Eigen::Vector3d line_direction = line.segment.Direction(), direction = edge.Direction();
  const double s = edge.Parameter(midpoint);
  const Eigen::Vector3d away = midpoint - edge.At(s);
  // If the edge is viewed end-on, the cross product and both offsets across vanish.
  const Eigen::Vector3d sideways = direction.cross(line.viewing_direction).normalized();
  Offset offset;
  offset.angle = UndirectedAngle(line_direction, direction);
  offset.angle_across = std::asin(std::min(std::abs(line_direction.dot(sideways)), 1.0));
  offset.across = std::abs(away.dot(sideways));
  offset.along = (away - away.dot(sideways) * sideways).norm();
  offset.beyond = edge.Length() * std::max({-s, s - 1.0, 0.0});
  return offset;
}

bool IsWithinBounds(const Offset& offset, const LineEvaluationOptions& options) {
  return offset.angle <= options.max_angle && offset.angle_across <= options.max_angle_across &&
         offset.across <= options.max_across && offset.along <= options.max_along &&
         offset.beyond <= options.max_beyond;
}

// Sum of the squared offsets, each relative to its bound.
double Cost(const Offset& offset, const LineEvaluationOptions& options) {
  return Eigen::Vector4d(offset.angle / options.max_angle,
                         offset.angle_across / options.max_angle_across,
                         offset.across / options.max_across, offset.along / options.max_along)
      .squaredNorm();
}

// Returns the index of the edge that matches the line; -1 if there is none.
int FindEdge(const EstimatedLine& line, const std::vector<LineSegment3>& edges,
             const LineEvaluationOptions& options) {
  int best = -1;
  double least = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < edges.size(); ++i) {
    const Offset offset = ComputeOffset(line, edges[i]);
    if (!IsWithinBounds(offset, options) || Cost(offset, options) >= least) continue;
    best = static_cast<int>(i);
    least = Cost(offset, options);
  }
  return best;
}

EstimatedLine Transformed(const Rigid3& reference_from_estimate, const EstimatedLine& line) {
  return {reference_from_estimate * line.segment, line.num_observations,
          reference_from_estimate.rotation() * line.viewing_direction};
}

}  // namespace

bool LineEvaluationOptions::IsValid(std::string* error) const {
  if (!(min_length > 0.0)) {
    *error = "line evaluation: min_length must be positive";
  } else if (!(max_across > 0.0 && max_angle_across > 0.0 && max_along > 0.0 && max_angle > 0.0)) {
    *error =
        "line evaluation: max_across, max_angle_across, max_along and max_angle must be positive";
  } else if (!(max_beyond >= 0.0)) {
    *error = "line evaluation: max_beyond must not be negative";
  } else {
    return true;
  }
  return false;
}

LineError EvaluateLines(const std::vector<LineSegment3>& edges,
                        const std::vector<EstimatedLine>& lines,
                        const Rigid3& reference_from_estimate,
                        const LineEvaluationOptions& options) {
  std::string problem;
  if (!options.IsValid(&problem)) throw std::invalid_argument(problem);
  for (const LineSegment3& edge : edges) {
    if (!(edge.Length() > 0.0)) {
      throw std::invalid_argument("line evaluation: an edge has no length; remove it");
    }
  }

  LineError error;
  error.num_lines = static_cast<int>(lines.size());
  error.num_edges = static_cast<int>(edges.size());
  std::vector<bool> is_found(edges.size(), false);
  std::vector<double> directions, distances, across;
  for (const EstimatedLine& estimated : lines) {
    if (estimated.num_observations < options.min_observations) continue;
    if (!(estimated.segment.Length() >= options.min_length)) continue;
    ++error.num_counted;
    const EstimatedLine line = Transformed(reference_from_estimate, estimated);
    const int edge = FindEdge(line, edges, options);
    if (edge < 0) continue;
    ++error.num_matched;
    is_found[edge] = true;
    const Offset offset = ComputeOffset(line, edges[edge]);
    directions.push_back(offset.angle);
    distances.push_back(offset.Distance());
    across.push_back(offset.across);
  }
  error.num_edges_found = static_cast<int>(std::count(is_found.begin(), is_found.end(), true));
  error.direction = StatisticsOf(directions);
  error.distance = StatisticsOf(distances);
  error.across = StatisticsOf(across);
  return error;
}

}  // namespace msc_vo
