// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "msc_vo/camera/pinhole_camera.h"
#include "msc_vo/geometry/rigid3.h"

namespace msc_vo {

// A line segment with end points start, end (pixels in 2-D, metres in 3-D). Paper: {s, e}, {S, E}.
// The numbers are contiguous (start first), so that `start.data()` is a parameter block.
template <int Dim>
struct LineSegment {
  using Vector = Eigen::Matrix<double, Dim, 1>;
  // Not aligned: the two end points must follow each other without a gap.
  using Point = Eigen::Matrix<double, Dim, 1, Eigen::DontAlign>;
  Point start = Point::Zero();
  Point end = Point::Zero();

  double Length() const { return (end - start).norm(); }
  // Unit vector from start to end, paper Eq. line-coef; the segment must have a length.
  Vector Direction() const { return (end - start).normalized(); }
  Vector Midpoint() const { return 0.5 * (start + end); }
  Vector At(double s) const { return start + s * (end - start); }
  // Parameter s of the foot of x on the infinite line: 0 at start, 1 at end.
  double Parameter(const Vector& x) const {
    return (x - start).dot(end - start) / (end - start).squaredNorm();
  }
  // Distance of x to the infinite line.
  double DistanceToLine(const Vector& x) const { return (x - At(Parameter(x))).norm(); }
};
using LineSegment2 = LineSegment<2>;
using LineSegment3 = LineSegment<3>;
static_assert(sizeof(LineSegment3) == 6 * sizeof(double), "must be one parameter block");

inline LineSegment3 operator*(const Rigid3& b_from_a, const LineSegment3& segment_in_a) {
  return {b_from_a * Eigen::Vector3d(segment_in_a.start),
          b_from_a * Eigen::Vector3d(segment_in_a.end)};
}

// The infinite image line through a segment as (n, c), |n| = 1, so that n . p + c is the signed
// distance of pixel p in pixels. Paper: n_j of Eq. errorreprline.
inline Eigen::Vector3d ImageLine(const LineSegment2& segment) {
  const Eigen::Vector2d d = segment.Direction();
  const Eigen::Vector2d n(-d.y(), d.x());
  return {n.x(), n.y(), -n.dot(segment.start)};
}

// Part of `segment` in front of the plane z = near (metres, camera coordinates).
// Returns false if nothing of it is.
bool ClipToNear(double near, LineSegment3* segment_in_cam);

// Part of `segment` inside the rectangle of `camera`'s image. Returns false if nothing of it is.
bool ClipToImage(const PinholeCamera& camera, LineSegment2* segment);

}  // namespace msc_vo
