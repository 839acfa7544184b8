// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/geometry/convex_polygon.h"

#include <algorithm>
#include <limits>

namespace msc_vo {

namespace {

using Eigen::Vector2d;

// Twice the area of a triangle, positive if its vertices are counter-clockwise.
double Cross(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

// Adds a vertex to a chain that turns left.
void Extend(size_t begin, const Vector2d& point, ConvexPolygon* chain) {
  while (chain->size() >= begin + 2 &&
         Cross((*chain)[chain->size() - 2], chain->back(), point) <= 0.0) {
    chain->pop_back();
  }
  chain->push_back(point);
}

// The largest distance by which an edge of `a` separates it from `b`; negative if none does.
double Separation(const ConvexPolygon& a, const ConvexPolygon& b) {
  double largest = -std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < a.size(); ++i) {
    const Vector2d edge = a[(i + 1) % a.size()] - a[i];
    const Vector2d outwards = Vector2d(edge.y(), -edge.x()).normalized();
    double nearest = std::numeric_limits<double>::infinity();
    for (const Vector2d& vertex : b) nearest = std::min(nearest, outwards.dot(vertex - a[i]));
    largest = std::max(largest, nearest);
  }
  return largest;
}

}  // namespace

// Monotone chain: the lower half of the hull from left to right, then the upper half back.
ConvexPolygon ConvexHull(std::vector<Vector2d> points) {
  std::sort(points.begin(), points.end(), [](const Vector2d& a, const Vector2d& b) {
    return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
  });
  ConvexPolygon hull;
  for (const Vector2d& point : points) Extend(0, point, &hull);
  const size_t begin = hull.empty() ? 0 : hull.size() - 1;
  for (size_t i = points.size(); i-- > 0;) Extend(begin, points[i], &hull);
  if (!hull.empty()) hull.pop_back();  // the first vertex again
  if (hull.size() < 3) hull.clear();
  return hull;
}

void Simplify(size_t max_vertices, ConvexPolygon* polygon) {
  while (polygon->size() > max_vertices) {
    const size_t size = polygon->size();
    size_t cheapest = 0;
    double least = std::numeric_limits<double>::infinity();
    for (size_t i = 0; i < size; ++i) {
      const double area =
          Cross((*polygon)[(i + size - 1) % size], (*polygon)[i], (*polygon)[(i + 1) % size]);
      if (area >= least) continue;
      least = area;
      cheapest = i;
    }
    polygon->erase(polygon->begin() + static_cast<std::ptrdiff_t>(cheapest));
  }
}

bool AreTouching(const ConvexPolygon& a, const ConvexPolygon& b, double gap) {
  return !a.empty() && !b.empty() && Separation(a, b) <= gap && Separation(b, a) <= gap;
}

}  // namespace msc_vo
