// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/tracking/motion_model.h"

#include <algorithm>

#include "msc_vo/geometry/so3.h"

namespace msc_vo {

namespace {

// Half a second ahead a hand has changed its mind: the model is not carried further than that.
constexpr double kHorizon = 0.5;

}  // namespace

void MotionModel::Observe(double timestamp, const Rigid3& cam_from_last) {
  interval_ = timestamp - last_timestamp_;
  velocity_ = cam_from_last;
  last_timestamp_ = timestamp;
}

void MotionModel::Reset(double timestamp) {
  interval_ = 0.0;
  velocity_ = Rigid3();
  last_timestamp_ = timestamp;
}

Rigid3 MotionModel::Predict(double timestamp) const {
  return Scaled(std::min(timestamp - last_timestamp_, kHorizon));
}

Rigid3 MotionModel::Over(double timestamp, double seconds) const {
  return timestamp - last_timestamp_ > kHorizon ? Rigid3() : Scaled(seconds);
}

Rigid3 MotionModel::Scaled(double seconds) const {
  if (interval_ <= 0.0) return Rigid3();
  const double scale = seconds / interval_;
  return {ExpSO3(scale * LogSO3(velocity_.rotation())), scale * velocity_.translation()};
}

}  // namespace msc_vo
