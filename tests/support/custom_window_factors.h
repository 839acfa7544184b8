// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include "tests/support/custom_pose_factors.h"

#include "msc_vo/bundle_adjustment/custom_factor.h"
#include "msc_vo/factors/relative_pose.h"

namespace msc_vo {

// Wheel odometry: the measured motion from keyframe a to keyframe b. Extra block 0 is its scale.
// Sigmas in radians and metres.
inline CustomFactor WheelStep(int64_t a, int64_t b, const Rigid3& b_from_a, double rotation_sigma,
                              double translation_sigma) {
  return {"wheel step to keyframe " + std::to_string(b),
          ScaledRelativePose::CreateShared(
              b_from_a, DiagonalPoseCovariance(rotation_sigma, translation_sigma)),
          nullptr,
          {BlockId::Pose(a), BlockId::Pose(b), BlockId::Extra(0)}};
}

// An extra block of one number.
inline ExtraBlock Scalar(int64_t id, double value) {
  ExtraBlock block;
  block.id = id;
  block.value = Eigen::VectorXd::Constant(1, value);
  return block;
}

}  // namespace msc_vo
