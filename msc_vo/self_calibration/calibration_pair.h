// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "msc_vo/camera/sensor_correction.h"
#include "msc_vo/frame/frame.h"
#include "msc_vo/geometry/rigid3.h"
#include "msc_vo/self_calibration/pair_linearization.h"
#include "msc_vo/sensor/inverse_depth_image.h"

namespace msc_vo {

/// An image for self-calibration: its features, its depth, and a first estimate of its pose.
struct CalibrationView {
  std::shared_ptr<const Frame> frame;
  InverseDepthImage depth;  ///< recorded, not registered by the correction
  Rigid3 cam_from_world;
};

/// Residual of a point that images a and b have in common: its prediction from image a minus its
/// observation in image b.
struct PairResidual {
  Eigen::Vector2d pixel;         ///< recorded, in image b
  Eigen::Vector2d reprojection;  ///< pixels
  double inverse_depth;          ///< observed in image b, 1/metres
  double inverse_depth_error;    ///< 1/metres
};

/// Points that two images have in common, for self-calibration.
class CalibrationPair {
 public:
  /// Matches the points of `a` that have a depth with those of `b` by descriptor. Both views must
  /// outlive the pair.
  CalibrationPair(const CorrectedCamera& camera, const CalibrationView* a,
                  const CalibrationView* b);

  size_t num_points() const { return points_.size(); }

  /// Optimises the relative pose for a given correction and linearises around both. Points on depth
  /// edges take no part, because a small shift of the depth image changes their depth by any
  /// amount. Returns std::nullopt if fewer than 30 points are left.
  ///
  /// Errors of a lens, of depth and of the shutter are common to the points of a pair: all of them
  /// together count at most like one point, see CommonVariance().
  std::optional<CalibrationInformation> Linearize(const SensorCorrection::Vector& correction) const;

  /// Residuals of all matched points with a surface in both images, outliers included, at the
  /// optimal relative pose. Empty if Linearize() returns std::nullopt.
  std::vector<PairResidual> Residuals(const SensorCorrection::Vector& correction) const;

 private:
  // The points with a surface at the correction.
  std::vector<CalibrationPoint> PointsWithSurfaces(
      const SensorCorrection::Vector& correction) const;

  CorrectedCamera camera_;
  const CalibrationView* a_;
  const CalibrationView* b_;
  std::vector<CalibrationPoint> points_;
};

}  // namespace msc_vo
