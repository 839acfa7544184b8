// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "msc_vo/camera/pinhole_camera.h"
#include "msc_vo/geometry/rigid3.h"

namespace msc_vo {

/// A directed line segment (pixels in 2-D, metres in 3-D); paper: {s, e}, {S, E}. The coordinates
/// are contiguous, start first, so `start.data()` is a parameter block.
template <int Dim>
struct LineSegment {
  using Vector = Eigen::Matrix<double, Dim, 1>;
  /// Not aligned: there must be no padding between the end points.
  using Point = Eigen::Matrix<double, Dim, 1, Eigen::DontAlign>;
  Point start = Point::Zero();
  Point end = Point::Zero();

  double Length() const { return (end - start).norm(); }
  /// Unit vector from start to end (paper Eq. line-coef); the length must be positive.
  Vector Direction() const { return (end - start).normalized(); }
  Vector Midpoint() const { return 0.5 * (start + end); }
  Vector At(double s) const { return start + s * (end - start); }
  /// Parameter s of the orthogonal projection of x onto the infinite line; 0: start, 1: end.
  double Parameter(const Vector& x) const {
    return (x - start).dot(end - start) / (end - start).squaredNorm();
  }
  /// Distance of x from the infinite line.
  double DistanceToLine(const Vector& x) const { return (x - At(Parameter(x))).norm(); }
};
using LineSegment2 = LineSegment<2>;
using LineSegment3 = LineSegment<3>;
static_assert(sizeof(LineSegment3) == 6 * sizeof(double), "must be one parameter block");

/// A part of a line, by the parameters of its ends: 0 and 1 are the ends of the whole segment.
struct LinePart {
  double start = 0.0;
  double end = 1.0;

  bool IsWhole() const { return start == 0.0 && end == 1.0; }
  LineSegment3 Of(const LineSegment3& line) const;
};

LineSegment3 operator*(const Rigid3& b_from_a, const LineSegment3& segment_in_a);

/// Infinite image line through a segment as (n, c) with |n| = 1: n . p + c is the signed distance
/// of pixel p, pixels. Paper: n_j of Eq. errorreprline.
Eigen::Vector3d ImageLine(const LineSegment2& segment);

/// Clips the segment to the half-space z >= near (metres, camera frame). Returns false if nothing
/// remains.
bool ClipToNear(double near, LineSegment3* segment_in_cam);

/// Clips the segment to the image of `camera`. Returns false if nothing remains.
bool ClipToImage(const PinholeCamera& camera, LineSegment2* segment);

}  // namespace msc_vo
