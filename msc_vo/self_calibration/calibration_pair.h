// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "msc_vo/camera/sensor_correction.h"
#include "msc_vo/factors/rgbd_pair_reprojection.h"
#include "msc_vo/geometry/rigid3.h"
#include "msc_vo/map/frame.h"
#include "msc_vo/sensor/inverse_depth_image.h"

namespace msc_vo {

/// An image for self-calibration: its features, its depth, and a first estimate of its pose.
struct CalibrationView {
  std::shared_ptr<const Frame> frame;
  InverseDepthImage depth;  ///< recorded, not registered by the correction
  Rigid3 cam_from_world;
};

/// What the points of one pair of images tell about a SensorCorrection: a quadratic approximation
/// of the negative log likelihood, with the relative pose marginalised,
/// x^T matrix x / 2 - vector^T x.
struct CalibrationInformation {
  SensorCorrection::Matrix matrix = SensorCorrection::Matrix::Zero();
  SensorCorrection::Vector vector = SensorCorrection::Vector::Zero();
};

/// Points that two images have in common, for self-calibration.
class CalibrationPair {
 public:
  /// Matches the points of `a` that have a depth with those of `b` by descriptor. Both views must
  /// outlive the pair.
  CalibrationPair(const CorrectedCamera& camera, const CalibrationView* a,
                  const CalibrationView* b);

  int num_points() const { return static_cast<int>(points_.size()); }

  /// Optimises the relative pose for a given correction and linearises around both. Points on depth
  /// edges take no part, because a small shift of the depth image changes their depth by any
  /// amount. Returns std::nullopt if fewer than 30 points are left.
  ///
  /// Errors of a lens, of depth and of the shutter are common to the points of a pair: all of them
  /// together count at most like one point with a sigma of 0.2 px.
  std::optional<CalibrationInformation> Linearize(const SensorCorrection::Vector& correction) const;

 private:
  struct Point {
    RgbdPairReprojection::View a;
    RgbdPairReprojection::View b;
    double inverse_depth = 0.0;  // of a, 1/metres, a first estimate
    double pixel_variance = 0.0;
  };

  CorrectedCamera camera_;
  const CalibrationView* a_;
  const CalibrationView* b_;
  std::vector<Point> points_;
};

}  // namespace msc_vo
