// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "msc_vo/camera/pinhole_camera.h"
#include "msc_vo/geometry/line_segment.h"

namespace msc_vo {

// A 3-D line seen along an image segment, as the inverse depth that it has at the segment's two end
// points.
//
// Why not end points in metres: every sample of a segment lies in the plane spanned by the optical
// centre and the segment, so the 3-D fit is a 2-D one; and in that plane the inverse depth 1/z of a
// 3-D line is exactly linear in the image, 1/z(s) = (1 - s) w_start + s w_end, while the noise of a
// disparity sensor is constant in 1/z. Total least squares on back-projected samples thus becomes
// weighted linear regression, with the right noise and an exact covariance.
struct LineDepth {
  double start = 0.0;                                    // w_start, 1/metres, positive
  double end = 0.0;                                      // w_end, 1/metres, positive
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  // of (start, end), 1/metres^2
  int num_inliers = 0;
  double inlier_ratio = 0.0;  // inliers / valid samples

  // Inverse depth at parameter s of the segment (0 start, 1 end; outside: extrapolated), 1/metres.
  double At(double s) const { return (1.0 - s) * start + s * end; }
  // Its standard deviation, 1/metres; grows outside [0, 1] as it must.
  double SigmaAt(double s) const {
    const Eigen::Vector2d a(1.0 - s, s);
    return std::sqrt(a.dot(covariance * a));
  }
};

// The same line with its depths z (metres) smaller by `offset`, |offset| much less than z.
LineDepth Nearer(const LineDepth& depth, double offset);

// The measured 3-D segment in camera coordinates (metres). `segment` is the image segment (pixels,
// undistorted) that `depth` belongs to.
LineSegment3 BackProject(const PinholeCamera& camera, const LineSegment2& segment,
                         const LineDepth& depth);

// Standard deviation of the direction of that segment, radians, to first order; across the plane of
// sight the direction is known much better, so this is its largest component.
double DirectionSigma(const PinholeCamera& camera, const LineSegment2& segment,
                      const LineDepth& depth);

struct LineFitOptions {
  // A sample is an inlier below this many of its own sigmas: 99 % quantile of a normal deviate.
  double inlier_sigmas = 2.576;
  // Pairs of samples tried, at most. 40 pairs hold a clean one with 99 % at 1/3 inliers.
  int max_iterations = 40;
  // Below this share of inliers among the samples the fit is refused: the segment then lies on a
  // depth edge, where neither side is the majority.
  double min_inlier_ratio = 0.5;
  int min_inliers = 5;

  bool IsValid(std::string* error) const;
};

// One sample along a segment.
struct LineFitSample {
  double s = 0.0;              // parameter on the image segment, 0 start, 1 end
  double inverse_depth = 0.0;  // 1/metres
  double sigma = 1e-3;         // 1/metres, > 0
};

// Seeded RANSAC over pairs of samples, then iterated weighted least squares on the inliers (paper:
// 3D Feature Position Estimation, first step). The same samples and seed give the same answer.
// std::nullopt if no line has enough inliers or an end point would not lie in front of the camera.
// Throws std::invalid_argument on options that are not valid.
std::optional<LineDepth> FitLineDepth(const LineFitOptions& options,
                                      const std::vector<LineFitSample>& samples, uint32_t seed);

}  // namespace msc_vo
