// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>

#include "msc_vo/factors/line_depth_reprojection.h"
#include "msc_vo/factors/line_reprojection.h"

namespace msc_vo {

// Operations on one observation that local bundle adjustment and pose optimization share.

/// Inlier flags of the two factors of an observation.
struct InlierMask {
  bool reprojection = false;
  bool depth = false;
  bool operator==(const InlierMask& other) const {
    return reprojection == other.reprojection && depth == other.depth;
  }
};

/// Chi-square test of an observation. `reprojection` and `depth`: squared norms of its residuals, 0
/// for a missing factor. `limit`, `limit_with_depth`: quantiles for the rows of the reprojection,
/// and of reprojection and depth together. An observation that fails only the second test loses its
/// depth and remains an inlier, as at mixed pixels of the depth image.
InlierMask TestChiSquare(double reprojection, double depth, double limit, double limit_with_depth);

/// Smallest valid depth z of an observed landmark, metres: below the range of RGB-D sensors, and
/// large enough that solver steps stay within the domain of the factors.
constexpr double kMinObservedDepth = 10.0 * kMinCameraDepth;

/// Shortest map line whose direction is usable, metres: its derivative is the inverse of the
/// length.
constexpr double kMinLineLength = 1e-6;

/// Whether a point, or both end points of a line, lie beyond kMinObservedDepth.
bool IsInFront(const Eigen::Vector3d& x_in_cam);
bool IsInFront(const LineSegment3& line_in_cam);

/// The part of a map line that an observation is compared with: the whole if both end points are
/// in front of the camera. Otherwise, as with a line that passes the camera, the part that is seen
/// between the end points of the observed `segment`, as far as that is in front and on the line.
/// std::nullopt if both end points are behind.
std::optional<LinePart> ObservedPart(const PinholeCamera& camera, const LineSegment2& segment,
                                     const LineSegment3& line_in_cam);

/// Standard deviation (pixels) of the observed image line's distance at the projection of `pixel`
/// on it. With independent errors of `sigma` pixels of both end points across the line, the
/// variance at parameter s (0 at the start, 1 at the end) is sigma^2 ((1 - s)^2 + s^2).
double ImageLineSigma(const LineSegment2& segment, double sigma, const Eigen::Vector2d& pixel);

/// Factors of one line observation, with their sigmas at the linearisation point `line_in_cam`: the
/// map line in camera coordinates, both end points in front of the camera.
LineReprojection MakeLineReprojection(const PinholeCamera& camera, const LineSegment2& segment,
                                      double sigma, const LineSegment3& line_in_cam);
LineDepthReprojection MakeLineDepthReprojection(const PinholeCamera& camera,
                                                const LineSegment2& segment, const LineDepth& depth,
                                                const LineSegment3& line_in_cam);

/// Residual of MakeLineReprojection, in standard deviations.
Eigen::Vector2d LineResidual(const PinholeCamera& camera, const LineSegment2& segment, double sigma,
                             const LineSegment3& line_in_cam);

/// Inverse depth (1/metres) of the map line at parameter s of the observed segment; std::nullopt if
/// both end points project to the same parameter, as those of a line along a viewing ray.
std::optional<double> InverseDepthAt(const PinholeCamera& camera, const LineSegment2& segment,
                                     const LineSegment3& line_in_cam, double s);

}  // namespace msc_vo
