// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/geometry/rigid3.h"

namespace msc_vo {

// Constant velocity between the last two estimated poses, scaled with time, so that a dropped frame
// does no harm.
class MotionModel {
 public:
  // Tells the pose of a frame. `cam_from_last` is the motion since the previous observed frame.
  void Observe(double timestamp, const Rigid3& cam_from_last);
  // Starts again at rest: the last frame was not a neighbour, or nothing is known of the motion.
  void Reset(double timestamp);

  // Motion from the last observed frame to a frame at `timestamp`.
  Rigid3 Predict(double timestamp) const;
  // Motion over so many seconds from `timestamp` on, backwards in time if negative. At rest if the
  // last observed frame is too long ago to tell.
  Rigid3 Over(double timestamp, double seconds) const;

 private:
  Rigid3 Scaled(double seconds) const;

  double last_timestamp_ = 0.0;
  double interval_ = 0.0;  // seconds that velocity_ took; 0: at rest
  Rigid3 velocity_;        // motion over that interval
};

}  // namespace msc_vo
