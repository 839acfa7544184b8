// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/geometry/line_segment.h"

#include <algorithm>
#include <utility>

namespace msc_vo {

LineSegment3 LinePart::Of(const LineSegment3& line) const {
  return IsWhole() ? line : LineSegment3{line.At(start), line.At(end)};
}

LineSegment3 operator*(const Rigid3& b_from_a, const LineSegment3& segment_in_a) {
  return {b_from_a * Eigen::Vector3d(segment_in_a.start),
          b_from_a * Eigen::Vector3d(segment_in_a.end)};
}

Eigen::Vector3d ImageLine(const LineSegment2& segment) {
  const Eigen::Vector2d d = segment.Direction();
  const Eigen::Vector2d n(-d.y(), d.x());
  return {n.x(), n.y(), -n.dot(segment.start)};
}

bool ClipToNear(double near, LineSegment3* segment_in_cam) {
  const double a = segment_in_cam->start.z() - near;
  const double b = segment_in_cam->end.z() - near;
  if (a < 0.0 && b < 0.0) return false;
  const LineSegment3 whole = *segment_in_cam;
  if (a < 0.0) segment_in_cam->start = whole.At(a / (a - b));
  if (b < 0.0) segment_in_cam->end = whole.At(a / (a - b));
  return true;
}

bool ClipToImage(const PinholeCamera& camera, LineSegment2* segment) {
  // Liang-Barsky: [first, last] is the interval of the segment's parameter inside all four borders.
  double first = 0.0;
  double last = 1.0;
  const Eigen::Vector2d d = segment->end - segment->start;
  const Eigen::Vector2d upper(camera.width - 1.0, camera.height - 1.0);
  for (int axis = 0; axis < 2; ++axis) {
    const double to_lower = -segment->start[axis];
    const double to_upper = upper[axis] - segment->start[axis];
    if (d[axis] == 0.0) {
      if (to_lower > 0.0 || to_upper < 0.0) return false;
      continue;
    }
    double enter = to_lower / d[axis];
    double leave = to_upper / d[axis];
    if (enter > leave) std::swap(enter, leave);
    first = std::max(first, enter);
    last = std::min(last, leave);
  }
  if (first > last) return false;
  const LineSegment2 whole = *segment;
  segment->start = whole.At(first);
  segment->end = whole.At(last);
  return true;
}

}  // namespace msc_vo
