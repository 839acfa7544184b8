// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <vector>

#include "msc_vo/synthetic/scene/random.h"
#include "msc_vo/synthetic/scene/scene.h"

namespace msc_vo {

/// A camera position over a floor plan and the direction of its view.
struct Step {
  double x = 0.0, y = 0.0;  ///< metres
  double heading = 0.0;     ///< degrees, from the x axis towards the y axis
  double floor = 0.0;       ///< height of the floor, metres
};

/// Writes the tour of a walk: positions at the height of the eyes, with small random deviations.
class TourWriter {
 public:
  /// `seed` of the scene; the deviations depend on the walk, too.
  TourWriter(uint64_t seed, const WalkOptions& walk) : random_(seed, walk.path) {}

  Random& random() { return random_; }

  /// Appends steps in the frame of `placement`; a reflection mirrors their headings.
  void Add(const Placement& placement, const std::vector<Step>& steps);

  const std::vector<Waypoint>& tour() const { return tour_; }

 private:
  Random random_;
  std::vector<Waypoint> tour_;
};

/// The tour of a scene with waypoints moved by up to some decimetres, as far as there is free
/// space: another walk through the same rooms. `path` is its number.
std::vector<Waypoint> OtherTour(const Scene& scene, uint64_t seed, uint64_t path);

/// The control points of the uniform cubic B-splines of a tour: the waypoints, and at the end of a
/// tour that is no loop, its ends so often that the splines reach them.
std::vector<Waypoint> ControlPoints(const Scene& scene);

/// The waypoint at `parameter` of the splines through control points, 0 to the number of their
/// pieces; a loop is continued at its beginning.
Waypoint SplineWaypoint(const std::vector<Waypoint>& control_points, double parameter);

}  // namespace msc_vo
