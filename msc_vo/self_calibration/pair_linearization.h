// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>
#include <vector>

#include "msc_vo/camera/sensor_correction.h"
#include "msc_vo/factors/rgbd_pair_reprojection.h"
#include "msc_vo/geometry/rigid3.h"

namespace msc_vo {

/// A point that two images, a and b, have in common.
struct CalibrationPoint {
  RgbdPairReprojection::View a;
  RgbdPairReprojection::View b;
  double inverse_depth = 0.0;   ///< of a, 1/metres, a first estimate
  double pixel_variance = 0.0;  ///< pixels^2, of both images together
};

/// Information of the points of a pair of images, of several ones or of a map about a
/// SensorCorrection: a quadratic approximation of the negative log likelihood, with poses and
/// points marginalised, x^T matrix x / 2 - vector^T x.
struct CalibrationInformation {
  SensorCorrection::Matrix matrix = SensorCorrection::Matrix::Zero();
  SensorCorrection::Vector vector = SensorCorrection::Vector::Zero();
  /// Sum of the inverse variances of the points, 1/pixels^2, if their errors are independent; of a
  /// map: of the points of one image, in the mean.
  double point_information = 0.0;

  CalibrationInformation& operator+=(const CalibrationInformation& other) {
    matrix += other.matrix;
    vector += other.vector;
    point_information += other.point_information;
    return *this;
  }
};

/// Returns what remains if the points have an error in common, besides their independent ones: all
/// of them together count at most like one point with `common_variance` (pixels^2).
CalibrationInformation WithCommonError(CalibrationInformation information, double common_variance);

/// Optimises the relative pose of a pair of images for a given correction, beginning with
/// `b_from_a`, where the points are weighted, and linearises around both. The errors of the points
/// count as independent. Returns std::nullopt if there are fewer than 30 points.
std::optional<CalibrationInformation> LinearizePair(const CorrectedCamera& camera,
                                                    const std::vector<CalibrationPoint>& points,
                                                    const SensorCorrection::Vector& correction,
                                                    Rigid3* b_from_a);

}  // namespace msc_vo
