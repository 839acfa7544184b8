// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/synthetic/scene/tour.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "msc_vo/geometry/angles.h"

namespace msc_vo {

namespace {

using Vec = Eigen::Vector3d;

// Distance from the camera to the point that it points at, metres: larger than the distance of two
// waypoints, so that the direction of the view stays determined between them.
constexpr double kViewDistance = 1.8;
// The largest distance from surfaces that a moved waypoint has to keep, metres.
constexpr double kMargin = 0.42;

// Uniform cubic B-spline at fraction f between the two middle ones of four control points.
Vec CubicBSpline(const Vec& a, const Vec& b, const Vec& c, const Vec& d, double f) {
  const double g = 1.0 - f;
  return (g * g * g * a + (3 * f * f * f - 6 * f * f + 4) * b +
          (3 * g * g * g - 6 * g * g + 4) * c + f * f * f * d) /
         6.0;
}

// The smallest distance from a surface along the pieces of a loop that waypoint `index` influences.
double ClearanceAround(const Scene& scene, const std::vector<Waypoint>& loop, size_t index) {
  constexpr int kSamples = 4;  // of a piece
  const size_t count = loop.size();
  double nearest = std::numeric_limits<double>::infinity();
  for (size_t piece = index + count - 3; piece <= index + count; ++piece) {
    for (int i = 0; i < kSamples; ++i) {
      const double parameter =
          static_cast<double>(piece % count) + static_cast<double>(i) / kSamples;
      nearest = std::min(nearest, scene.Clearance(SplineWaypoint(loop, parameter).position));
    }
  }
  return nearest;
}

}  // namespace

void TourWriter::Add(const Placement& placement, const std::vector<Step>& steps) {
  for (const Step& step : steps) {
    const Vec position(step.x + random_.Uniform(-0.05, 0.05), step.y + random_.Uniform(-0.05, 0.05),
                       step.floor + 1.45 + random_.Uniform(-0.08, 0.08));
    const double heading = DegreesToRadians(step.heading + random_.Uniform(-6.0, 6.0));
    const Vec target = position + kViewDistance * Vec(std::cos(heading), std::sin(heading), 0.0) -
                       Vec(0, 0, random_.Uniform(0.15, 0.45));
    tour_.push_back({placement.linear * position + placement.offset,
                     placement.linear * target + placement.offset});
  }
}

std::vector<Waypoint> OtherTour(const Scene& scene, uint64_t seed, uint64_t path) {
  Random random(seed, path);
  std::vector<Waypoint> tour = scene.tour;
  for (size_t i = 0; i < tour.size(); ++i) {
    const Waypoint before = tour[i];
    const double least = std::min(kMargin, ClearanceAround(scene, tour, i));
    const Vec turn(random.Uniform(-0.5, 0.5), random.Uniform(-0.5, 0.5), random.Uniform(-0.2, 0.2));
    Vec move(random.Uniform(-0.35, 0.35), random.Uniform(-0.35, 0.35), random.Uniform(-0.1, 0.1));
    for (int halvings = 0; halvings < 3; ++halvings, move *= 0.5) {
      tour[i] = {before.position + move, before.target + move + turn};
      if (ClearanceAround(scene, tour, i) >= least) break;
      tour[i] = {before.position, before.target + turn};
    }
  }
  return tour;
}

std::vector<Waypoint> ControlPoints(const Scene& scene) {
  std::vector<Waypoint> points = scene.tour;
  if (scene.tour_is_loop || points.empty()) return points;
  points.insert(points.begin(), 2, scene.tour.front());
  points.insert(points.end(), 2, scene.tour.back());
  return points;
}

Waypoint SplineWaypoint(const std::vector<Waypoint>& control_points, double parameter) {
  const size_t count = control_points.size();
  const size_t knot = static_cast<size_t>(parameter);
  const double f = parameter - static_cast<double>(knot);
  const Waypoint* w[4];
  for (size_t k = 0; k < 4; ++k) w[k] = &control_points[(knot + k) % count];
  return {CubicBSpline(w[0]->position, w[1]->position, w[2]->position, w[3]->position, f),
          CubicBSpline(w[0]->target, w[1]->target, w[2]->target, w[3]->target, f)};
}

}  // namespace msc_vo
