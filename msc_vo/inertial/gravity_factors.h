// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include <Eigen/Core>

#include "msc_vo/geometry/timed_acceleration.h"
#include "msc_vo/mapping/window_factors.h"

namespace msc_vo {

struct GravityOptions {
  /// Standard deviation of each component of a measured vertical, radians, apart from the scatter
  /// of the lengths: the rotation between keyframes is interpolated. A sensor with a bias needs
  /// more. Chosen by measurement, see docs/lab/gravity.md.
  double min_sigma = 0.0005;
  /// Id of the extra block with the vertical in world 0. That in world w has the id block + w.
  int64_t block = 0;
};

/// Ties roll and pitch of the keyframes of every window to an accelerometer. The vertical, a unit
/// vector in the world that points up, is an extra block, which all windows of that world estimate
/// together: its prior is the mean of the verticals measured so far. The standard deviation of a
/// measurement is estimated from the scatter of the lengths in its window: an error of the
/// acceleration of the camera changes length and direction alike.
///
///   GravityFactors gravity(readings, GravityOptions());
///   odometry.SetWindowFactors(std::ref(gravity));
class GravityFactors {
 public:
  /// `readings`: in the axes of the camera, in order of time.
  /// Throws std::invalid_argument if min_sigma is not positive.
  GravityFactors(std::vector<TimedAcceleration> readings, const GravityOptions& options);

  /// Returns the factors of a window; none before the vertical has been measured.
  WindowFactors operator()(const WindowContext& window);

  /// Whether the vertical has been measured in any world.
  bool HasMeasured() const;

  /// Lists the state for a checkpoint.
  template <typename Archive>
  void Serialize(Archive& archive) {
    auto& [readings, options, verticals] = *this;  // all members, or it does not compile
    archive(verticals);
  }

 private:
  // What has been measured of the vertical in a world.
  struct MeasuredVertical {
    std::vector<KeyframeId> keyframes;              // ascending
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();  // weighted by information, world
    double information = 0.0;                       // of the mean, 1/radians^2
  };

  std::vector<TimedAcceleration> readings_;
  GravityOptions options_;
  std::map<int, MeasuredVertical> verticals_;  // by world
};

}  // namespace msc_vo
