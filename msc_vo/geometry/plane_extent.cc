// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/geometry/plane_extent.h"

#include <Eigen/Geometry>

#include "msc_vo/geometry/convex_polygon.h"

namespace msc_vo {

namespace {

using Eigen::Vector3d;

// Coordinates on a plane, with its normal the right-handed third axis.
class PlaneAxes {
 public:
  explicit PlaneAxes(const Plane& plane)
      : origin_(-plane.offset() * plane.normal()),
        u_(plane.normal().unitOrthogonal()),
        v_(plane.normal().cross(u_)) {}

  ConvexPolygon ToPlane(const std::vector<Vector3d>& points) const {
    ConvexPolygon polygon;
    polygon.reserve(points.size());
    for (const Vector3d& x : points) polygon.emplace_back(u_.dot(x), v_.dot(x));
    return polygon;
  }
  PlaneExtent FromPlane(const ConvexPolygon& polygon) const {
    PlaneExtent extent;
    extent.reserve(polygon.size());
    for (const auto& x : polygon) extent.push_back(origin_ + x[0] * u_ + x[1] * v_);
    return extent;
  }

 private:
  Vector3d origin_, u_, v_;
};

}  // namespace

Vector3d Project(const Plane& plane, const Vector3d& point) {
  return point - (plane.normal().dot(point) + plane.offset()) * plane.normal();
}

PlaneExtent ConvexHull(const Plane& plane, const std::vector<Vector3d>& points,
                       size_t max_vertices) {
  const PlaneAxes axes(plane);
  ConvexPolygon hull = ConvexHull(axes.ToPlane(points));
  Simplify(max_vertices, &hull);
  return axes.FromPlane(hull);
}

bool AreTouching(const Plane& plane, const PlaneExtent& a, const PlaneExtent& b, double gap) {
  const PlaneAxes axes(plane);
  return AreTouching(axes.ToPlane(a), axes.ToPlane(b), gap);
}

PlaneExtent operator*(const Rigid3& target_from_source, const PlaneExtent& extent) {
  PlaneExtent moved;
  moved.reserve(extent.size());
  for (const Vector3d& vertex : extent) moved.push_back(target_from_source * vertex);
  return moved;
}

}  // namespace msc_vo
