// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <array>
#include <string>
#include <vector>

#include "msc_vo/geometry/rigid3.h"
#include "msc_vo/synthetic/scene/scene.h"

namespace msc_vo {

struct PathOptions {
  /// Mean bounds along the nominal path, those of a walking person. The actual pace varies by 30 %;
  /// the shake adds some cm/s and some degrees/s.
  double speed = 0.35;      ///< metres/second
  double turn_rate = 0.45;  ///< radians/second (26 degrees/second)
  double shake = 1.0;       ///< amplitude of the shake relative to a hand's; 0: none
  uint64_t seed = 1;        ///< of the start on the loop, the shake and the variation of the pace

  bool IsValid(std::string* error) const;
};

/// Trajectory of a hand-held camera along the tour of a scene, an endless loop or a walk from its
/// beginning to its end, where the camera stays: uniform cubic
/// B-splines through positions and targets (continuous acceleration, within the convex hull of four
/// waypoints), a pace that slows down in turns, and a shake of incommensurate sines, so rounds do
/// not repeat.
class CameraPath {
 public:
  /// Throws std::invalid_argument on invalid options or a tour of fewer than 4 waypoints.
  CameraPath(const Scene& scene, const PathOptions& options);

  /// Pose (camera frame from world frame) at `seconds` after the start; may be negative.
  Rigid3 CamFromWorld(double seconds) const;

  /// Duration of one round, or of a walk that is no loop, seconds; the pace changes it by up to
  /// half a second.
  double LoopSeconds() const { return seconds_at_.back(); }

 private:
  double ParameterAt(double seconds) const;
  double ParameterInTour(double seconds) const;  // 0 to LoopSeconds()
  void BuildTimetable();

  std::vector<Waypoint> control_points_;
  bool is_loop_ = true;
  PathOptions options_;
  std::vector<double> seconds_at_;  // at equally spaced spline parameters, without pace and shake
  double start_seconds_ = 0.0;
  std::array<double, 14> phases_{};  // radians: 6 axes with two sines each, then 2 of the pace
};

/// Pose (camera frame from world frame) of a camera at `position` that points at `target`, with the
/// image's y axis downwards (world z is up).
Rigid3 LookAt(const Eigen::Vector3d& position, const Eigen::Vector3d& target);

}  // namespace msc_vo
