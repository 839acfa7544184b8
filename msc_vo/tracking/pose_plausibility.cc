// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/tracking/pose_plausibility.h"

#include <cmath>
#include <utility>

#include "msc_vo/geometry/so3.h"

namespace msc_vo {

namespace {

// Seconds for which the frames that follow are implausible, too: the default of
// SegmentOptions::max_search, for which a lost map is searched.
constexpr double kImplausibleSeconds = 5.0;
// A search is made because the camera moves faster than predicted.
constexpr double kSearchFactor = 3.0;

}  // namespace

void PosePlausibility::Observe(double timestamp, const CameraVelocity& velocity,
                               PoseOrigin origin) {
  if (origin == PoseOrigin::kPrediction) {
    if (!IsImplausible(timestamp)) limits_.Observe(velocity);
    return;
  }
  const double factor = origin == PoseOrigin::kSearch ? kSearchFactor : 1.0;
  if (!limits_.Allow({velocity.angular / factor, velocity.linear / factor})) {
    MarkImplausible(timestamp);
  }
}

void PosePlausibility::MarkImplausible(double timestamp) {
  implausible_until_ = timestamp + kImplausibleSeconds;
  is_marked_ = true;
}

const PoseCovariance& PosePlausibility::UpdateJumpCovariance(double timestamp,
                                                             const Rigid3& cam_from_last,
                                                             const Rigid3& cam_from_predicted) {
  jump_covariance_ = TransportCovariance(cam_from_last, jump_covariance_);
  if (!IsImplausible(timestamp)) jump_covariance_.setZero();
  if (std::exchange(is_marked_, false)) {
    // The jump is the standard deviation of the three axes together.
    const double per_axis = 1.0 / std::sqrt(3.0);
    const PoseCovariance of_jump =
        IsotropicCovariance(per_axis * LogSO3(cam_from_predicted.rotation()).norm(),
                            per_axis * cam_from_predicted.translation().norm());
    if (of_jump.trace() > jump_covariance_.trace()) jump_covariance_ = of_jump;
  }
  return jump_covariance_;
}

}  // namespace msc_vo
