// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/synthetic/scene/camera_path.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <Eigen/Geometry>

#include "msc_vo/geometry/angles.h"
#include "msc_vo/geometry/so3.h"
#include "msc_vo/synthetic/scene/random.h"
#include "msc_vo/synthetic/scene/tour.h"

namespace msc_vo {

namespace {

// Entries of the timetable per waypoint: steps of 2 to 3 mm, a fraction of the motion per frame.
constexpr int kStepsPerWaypoint = 400;

// Shake of the hand: two sines per axis, with the frequencies of slow sway and of steps. Their
// ratios are irrational in effect, so the sum does not repeat. The amplitudes agree with those of
// hand-held recordings within a factor of two.
constexpr double kSlow = 0.61, kFast = 1.37;  // hertz, times the axis factors below
constexpr double kAxisFactor[6] = {1.0, 0.87, 1.23, 1.07, 0.79, 1.31};
constexpr double kShiftSlow = 0.006, kShiftFast = 0.002;                      // metres
constexpr double kTurnSlow = 0.35 * kPi / 180, kTurnFast = 0.15 * kPi / 180;  // radians

// Pace: the path is followed up to a third faster or slower than nominal.
constexpr double kPaceFrequency[2] = {0.11, 0.173};  // hertz
constexpr double kPaceAmplitude = 0.15;              // of each of the two sines

// Sum of the two sines of an axis with amplitudes `slow` and `fast`.
double Shake(double slow, double fast, int axis, double seconds, const double* phases) {
  const double cycle = 2.0 * kPi * kAxisFactor[axis] * seconds;
  return slow * std::sin(kSlow * cycle + phases[0]) + fast * std::sin(kFast * cycle + phases[1]);
}

}  // namespace

bool PathOptions::IsValid(std::string* error) const {
  if (!(speed > 0.0) || !(turn_rate > 0.0)) {
    *error = "path: speed (metres/second) and turn_rate (radians/second) must be positive";
  } else if (!(shake >= 0.0)) {
    *error = "path: shake must not be negative";
  } else {
    return true;
  }
  return false;
}

CameraPath::CameraPath(const Scene& scene, const PathOptions& options)
    : control_points_(ControlPoints(scene)), is_loop_(scene.tour_is_loop), options_(options) {
  std::string error;
  if (!options.IsValid(&error)) throw std::invalid_argument("CameraPath: " + error);
  if (control_points_.size() < 4) {
    throw std::invalid_argument("CameraPath: the scene's tour needs at least 4 waypoints");
  }
  Random random(options.seed, 0x70617468);
  for (double& phase : phases_) phase = random.Uniform(0.0, 2.0 * kPi);
  BuildTimetable();
  if (is_loop_) start_seconds_ = random.Uniform(0.0, LoopSeconds());
}

void CameraPath::BuildTimetable() {
  const size_t num_pieces = control_points_.size() - (is_loop_ ? 0 : 3);
  const int steps = kStepsPerWaypoint * static_cast<int>(num_pieces);
  seconds_at_.assign(1, 0.0);
  Waypoint last = SplineWaypoint(control_points_, 0.0);
  for (int i = 1; i <= steps; ++i) {
    const Waypoint next =
        SplineWaypoint(control_points_, static_cast<double>(i) / kStepsPerWaypoint);
    const double move = (next.position - last.position).norm() / options_.speed;
    const Eigen::Vector3d from = last.target - last.position, to = next.target - next.position;
    const double turn = std::atan2(from.cross(to).norm(), from.dot(to)) / options_.turn_rate;
    // The norm of both times respects both bounds and is smooth, unlike their maximum.
    seconds_at_.push_back(seconds_at_.back() + std::hypot(move, turn));
    last = next;
  }
}

double CameraPath::ParameterAt(double seconds) const {
  if (!is_loop_) return ParameterInTour(std::clamp(seconds, 0.0, LoopSeconds()));
  const double remainder = std::fmod(seconds, LoopSeconds());
  return ParameterInTour(remainder < 0.0 ? remainder + LoopSeconds() : remainder);
}

double CameraPath::ParameterInTour(double seconds) const {
  const auto after = std::upper_bound(seconds_at_.begin(), seconds_at_.end() - 1, seconds);
  const size_t i = static_cast<size_t>(after - seconds_at_.begin()) - 1;
  const double f = (seconds - seconds_at_[i]) / (seconds_at_[i + 1] - seconds_at_[i]);
  return (static_cast<double>(i) + f) / kStepsPerWaypoint;
}

Rigid3 CameraPath::CamFromWorld(double seconds) const {
  double path_seconds = start_seconds_ + seconds;
  for (int k = 0; k < 2; ++k) {
    const double rate = 2.0 * kPi * kPaceFrequency[k], phase = phases_[12 + k];
    path_seconds += kPaceAmplitude / rate * (std::sin(rate * seconds + phase) - std::sin(phase));
  }
  const Waypoint nominal = SplineWaypoint(control_points_, ParameterAt(path_seconds));
  Eigen::Vector3d shift, turn;
  for (int axis = 0; axis < 3; ++axis) {
    shift[axis] = Shake(kShiftSlow, kShiftFast, axis, seconds, &phases_[2 * axis]);
    turn[axis] = Shake(kTurnSlow, kTurnFast, axis + 3, seconds, &phases_[2 * axis + 6]);
  }
  const Rigid3 shaken_from_cam(ExpSO3(options_.shake * turn), options_.shake * shift);
  return shaken_from_cam * LookAt(nominal.position, nominal.target);
}

Rigid3 LookAt(const Eigen::Vector3d& position, const Eigen::Vector3d& target) {
  const Eigen::Vector3d z = (target - position).normalized();
  const Eigen::Vector3d x = z.cross(Eigen::Vector3d::UnitZ()).normalized();
  Eigen::Matrix3d cam_from_world;
  cam_from_world << x.transpose(), z.cross(x).transpose(), z.transpose();
  const Eigen::Quaterniond rotation(cam_from_world);
  return {rotation, -(rotation * position)};
}

}  // namespace msc_vo
