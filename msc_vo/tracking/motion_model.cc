// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/tracking/motion_model.h"

#include <algorithm>

namespace msc_vo {

namespace {

// Seconds; the motion of a hand-held camera is not predictable over longer intervals.
constexpr double kHorizon = 0.5;

}  // namespace

void MotionModel::Observe(double timestamp, const Rigid3& cam_from_last) {
  const std::optional<CameraVelocity> velocity = VelocitySince(timestamp, cam_from_last);
  if (!velocity) return Reset(timestamp);
  velocity_ = *velocity;
  interval_ = timestamp - last_timestamp_;
  last_timestamp_ = timestamp;
}

void MotionModel::Reset(double timestamp) {
  velocity_ = {};
  interval_ = 0.0;
  last_timestamp_ = timestamp;
}

Rigid3 MotionModel::Predict(double timestamp) const {
  return velocity_.Over(std::min(timestamp - last_timestamp_, kHorizon));
}

std::optional<CameraVelocity> MotionModel::VelocityAt(double timestamp) const {
  if (interval_ <= 0.0 || timestamp - last_timestamp_ > kHorizon) return std::nullopt;
  return velocity_;
}

std::optional<CameraVelocity> MotionModel::VelocitySince(double timestamp,
                                                         const Rigid3& cam_from_last) const {
  const double seconds = timestamp - last_timestamp_;
  if (!(seconds > 0.0 && seconds <= kHorizon)) return std::nullopt;
  return CameraVelocity::Of(cam_from_last, seconds);
}

std::optional<CameraVelocity> MotionModel::LastVelocity(double timestamp,
                                                        const Rigid3& cam_from_last) const {
  std::optional<CameraVelocity> after = VelocitySince(timestamp, cam_from_last);
  if (!after || interval_ <= 0.0) return after;
  // Mean velocities are those at the middles of the intervals: interpolate linearly between them.
  const double weight = interval_ / (interval_ + timestamp - last_timestamp_);
  return CameraVelocity{velocity_.angular + weight * (after->angular - velocity_.angular),
                        velocity_.linear + weight * (after->linear - velocity_.linear)};
}

PoseCovariance CovarianceOfRest(double seconds) {
  constexpr double kSpeedSigma = 0.5, kTurnSigma = 1.0;  // m/s, rad/s
  return IsotropicCovariance(kTurnSigma * seconds, kSpeedSigma * seconds);
}

}  // namespace msc_vo
