// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/factors/line_depth_reprojection.h"
#include "msc_vo/factors/line_reprojection.h"

namespace msc_vo {

// What both problems do with one observation.

// Which factors of an observation take part.
struct InlierMask {
  bool reprojection = false;
  bool depth = false;
  bool operator==(const InlierMask& other) const {
    return reprojection == other.reprojection && depth == other.depth;
  }
};

// The chi-square test of an observation: `reprojection` and `depth` are the squared norms of its
// residuals in sigmas (0 where there is none), the limits are quantiles for the rows of the first
// and of both. An observation whose depth alone contradicts stays and loses its depth: that is what
// a mixed pixel of the sensor looks like.
InlierMask TestChiSquare(double reprojection, double depth, double limit, double limit_with_depth);

// Nearest depth z (metres) at which an observation is believed: nearer than any RGB-D sensor sees,
// and ten times the factors' own limit, so that no step of a solver leaves the factors' domain.
constexpr double kMinObservedDepth = 10.0 * kMinCameraDepth;

bool IsInFront(const Eigen::Vector3d& x_in_cam);
bool IsInFront(const LineSegment3& line_in_cam);

// Standard deviation (pixels) of the observed image line's distance where `pixel` projects on it.
// The end points of the observed segment have independent errors of `sigma` pixels across the line,
// so at parameter s (0 start, 1 end) the line between them has sigma^2 ((1 - s)^2 + s^2): least in
// the middle, sigma sqrt(1/2), and growing linearly beyond the ends.
double ImageLineSigma(const LineSegment2& segment, double sigma, const Eigen::Vector2d& pixel);

// The factors of one line observation with their sigmas at the linearisation point: `line_in_cam`
// is the map line in camera coordinates, both end points in front of the camera.
LineReprojection MakeLineReprojection(const PinholeCamera& camera, const LineSegment2& segment,
                                      double sigma, const LineSegment3& line_in_cam);
LineDepthReprojection MakeLineDepthReprojection(const PinholeCamera& camera,
                                                const LineSegment2& segment, const LineDepth& depth,
                                                const LineSegment3& line_in_cam);

// The residual of the first of them, in its sigmas.
Eigen::Vector2d LineResidual(const PinholeCamera& camera, const LineSegment2& segment, double sigma,
                             const LineSegment3& line_in_cam);

// Inverse depth (1/metres) of the map line where the observed segment has parameter s.
double InverseDepthAt(const PinholeCamera& camera, const LineSegment2& segment,
                      const LineSegment3& line_in_cam, double s);

}  // namespace msc_vo
