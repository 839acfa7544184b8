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
  // Bounds along the planned way, as somebody walks who looks around with a camera. The pace varies
  // about them by 30 %, and the hand's shake comes on top: some cm/s and some degrees/s.
  double speed = 0.35;      // metres/second
  double turn_rate = 0.45;  // radians/second, 26 degrees
  double shake = 1.0;       // size of the hand's shake, 0: a rail
  uint64_t seed = 1;        // of the start on the loop, the shake and the changes of pace

  bool IsValid(std::string* error) const;
};

// A hand-held camera's way along the tour of a scene, round and round: cubic B-splines through
// positions and targets (smooth to the acceleration, never outside the hull of four waypoints), a
// pace that slows down in turns, and a shake of incommensurate sines, so that no round repeats.
class CameraPath {
 public:
  // Throws std::invalid_argument on options that are not valid or a tour of fewer than 4 waypoints.
  CameraPath(const Scene& scene, const PathOptions& options);

  // Pose after `seconds`; before the start, where they are negative, the same way goes on.
  Rigid3 CamFromWorld(double seconds) const;

  // Time of one round.
  double LoopSeconds() const { return seconds_at_.back(); }

 private:
  struct Gaze {
    Eigen::Vector3d position, target;
  };
  Gaze GazeAt(double parameter) const;
  double ParameterAt(double seconds) const;
  void BuildTimetable();

  std::vector<Waypoint> tour_;
  PathOptions options_;
  std::vector<double> seconds_at_;  // when the planned way passes equally spaced parameters
  double start_seconds_ = 0.0;
  std::array<double, 14> phases_{};  // radians: 6 axes with two sines each, and 2 of the pace
};

// The pose at `position` that looks at `target` with the image's y axis downwards (world z is up).
Rigid3 LookAt(const Eigen::Vector3d& position, const Eigen::Vector3d& target);

}  // namespace msc_vo
