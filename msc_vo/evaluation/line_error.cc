// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/evaluation/line_error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "msc_vo/geometry/angles.h"

namespace msc_vo {

namespace {

// Lines with fewer observations are skipped: no third view has confirmed the match of the first
// two.
constexpr int kMinObservations = 3;
// Shorter lines are skipped, metres: 20 cm are 35 pixels at 3 m, where half a pixel at an end turns
// the line by a degree.
constexpr double kMinLength = 0.20;
// Bounds across: the image measures an edge to a pixel or two, which is 10 mm at 3 m for a focal
// length of 525 px and, in opposite directions at both ends of 20 cm, 3 degrees. A line with a
// larger offset belongs to another edge.
constexpr double kMaxAcross = 0.01;                        // metres
constexpr double kMaxAngleAcross = DegreesToRadians(3.0);  // radians
// Bounds along the viewing direction: the depth at one or both ends may be that of the surface
// behind the edge. 0.1 m are ten standard deviations of a Kinect at 2.5 m; over 20 cm they are a
// slope of 27 degrees.
constexpr double kMaxAlong = 0.10;                    // metres
constexpr double kMaxAngle = DegreesToRadians(27.0);  // radians, total angle
// Distance of the line's midpoint beyond the end of the edge, metres: lines grow while they are
// observed.
constexpr double kMaxBeyond = 0.10;

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

bool IsWithinBounds(const Offset& offset) {
  return offset.angle <= kMaxAngle && offset.angle_across <= kMaxAngleAcross &&
         offset.across <= kMaxAcross && offset.along <= kMaxAlong && offset.beyond <= kMaxBeyond;
}

// Sum of the squared offsets, each relative to its bound.
double Cost(const Offset& offset) {
  return Eigen::Vector4d(offset.angle / kMaxAngle, offset.angle_across / kMaxAngleAcross,
                         offset.across / kMaxAcross, offset.along / kMaxAlong)
      .squaredNorm();
}

// Returns the index of the edge that matches the line; -1 if there is none.
int FindEdge(const EstimatedLine& line, const std::vector<LineSegment3>& edges) {
  int best = -1;
  double least = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < edges.size(); ++i) {
    const Offset offset = ComputeOffset(line, edges[i]);
    if (!IsWithinBounds(offset) || Cost(offset) >= least) continue;
    best = static_cast<int>(i);
    least = Cost(offset);
  }
  return best;
}

EstimatedLine Transformed(const Rigid3& reference_from_estimate, const EstimatedLine& line) {
  return {reference_from_estimate * line.segment, line.num_observations,
          reference_from_estimate.rotation() * line.viewing_direction};
}

}  // namespace

LineError EvaluateLines(const std::vector<LineSegment3>& edges,
                        const std::vector<EstimatedLine>& lines,
                        const Rigid3& reference_from_estimate) {
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
    if (estimated.num_observations < kMinObservations) continue;
    if (!(estimated.segment.Length() >= kMinLength)) continue;
    ++error.num_counted;
    const EstimatedLine line = Transformed(reference_from_estimate, estimated);
    const int edge = FindEdge(line, edges);
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
