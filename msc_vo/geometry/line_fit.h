// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "msc_vo/camera/pinhole_camera.h"
#include "msc_vo/geometry/line_segment.h"

namespace msc_vo {

/// Depth of a 3-D line along its image segment: the inverse depths at the segment's two end points.
///
/// All samples of a segment lie in the interpretation plane, spanned by the optical centre and the
/// segment, so the 3-D fit is two-dimensional. In that plane the inverse depth of a 3-D line is
/// exactly linear along the image segment, 1/z(s) = (1 - s) w_start + s w_end, and the noise of a
/// disparity sensor is constant in 1/z. Total least squares over back-projected samples thus
/// reduces to weighted linear regression with the correct noise model and an exact covariance.
struct LineDepth {
  double start = 0.0;                                    ///< w_start, 1/metres, positive
  double end = 0.0;                                      ///< w_end, 1/metres, positive
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  ///< of (start, end), 1/metres^2
  int num_inliers = 0;
  double inlier_ratio = 0.0;  ///< inliers / valid samples

  /// Inverse depth at parameter s of the segment, 1/metres; 0: start, 1: end, extrapolated beyond.
  double At(double s) const { return (1.0 - s) * start + s * end; }
  /// Standard deviation of At(s), 1/metres; increases with extrapolation.
  double SigmaAt(double s) const;
};

/// Returns the depth of the line moved towards the camera: its depths z are smaller by `offset`
/// metres, where |offset| << z.
LineDepth Nearer(const LineDepth& depth, double offset);

/// Returns the measured 3-D segment in the camera frame, metres. `segment` is the image segment
/// (pixels, undistorted) that `depth` belongs to.
LineSegment3 BackProject(const PinholeCamera& camera, const LineSegment2& segment,
                         const LineDepth& depth);

/// Standard deviation of the direction of the back-projected segment within its interpretation
/// plane, radians, to first order. The standard deviation across that plane is much smaller.
double DirectionSigma(const PinholeCamera& camera, const LineSegment2& segment,
                      const LineDepth& depth);

/// One depth sample along a segment.
struct LineFitSample {
  double s = 0.0;              ///< parameter on the image segment, 0: start, 1: end
  double inverse_depth = 0.0;  ///< 1/metres
  double sigma = 1e-3;         ///< 1/metres, > 0
};

/// Fits the depth of a line to samples: seeded RANSAC over pairs of samples, then iterated weighted
/// least squares on the inliers (paper: 3D Feature Position Estimation, first step). Deterministic.
/// Returns std::nullopt if no line has enough inliers or an end point is not in front of the
/// camera.
std::optional<LineDepth> FitLineDepth(const std::vector<LineFitSample>& samples, uint32_t seed);

}  // namespace msc_vo
