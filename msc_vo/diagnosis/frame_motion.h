// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>
#include <vector>

#include "msc_vo/frame/frame.h"
#include "msc_vo/geometry/rigid3.h"

namespace msc_vo {

/// Two observations of one point; the first one has a depth.
struct PointPair {
  PointFeature from;
  PointFeature to;
};

/// Relative pose of two frames.
struct FrameMotion {
  Rigid3 to_from_from;            ///< maps coordinates of the first camera to the second one
  std::vector<PointPair> points;  ///< inliers
  double median_error = 0.0;      ///< pixels, reprojection error of the inliers
};

/// Estimates the motion between two frames from the points that have a depth in `from` and match by
/// descriptor within `radius` pixels of the position that `guess` predicts: robust least squares of
/// the reprojection errors. Returns std::nullopt if fewer than 25 points agree.
std::optional<FrameMotion> EstimateFrameMotion(const Frame& from, const Frame& to,
                                               const Rigid3& guess, double radius);

}  // namespace msc_vo
