// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <limits>
#include <type_traits>
#include <vector>

#include "msc_vo/factors/depth_reprojection.h"
#include "msc_vo/factors/line_depth_reprojection.h"
#include "msc_vo/factors/line_reprojection.h"
#include "msc_vo/factors/point_reprojection.h"

namespace msc_vo {

/// One observation of a point (Points = 1) or a line (2) from a known pose.
template <int Points>
struct LandmarkView {
  using Reprojection = std::conditional_t<Points == 1, PointReprojection, LineReprojection>;
  using Depth = std::conditional_t<Points == 1, DepthReprojection, LineDepthReprojection>;

  Eigen::Matrix3d rotation;     ///< Of cam_from_world.
  Eigen::Vector3d translation;  ///< Of cam_from_world, metres.
  const Reprojection* reprojection = nullptr;
  const Depth* depth = nullptr;  ///< Null: not measured or left out.
  int source = 0;                ///< Position of the observation in the data.
};

/// Landmark that minimises the sum of squares of its views.
template <int Points>
struct LandmarkFit {
  Eigen::Matrix<double, 3 * Points, 1> x;  ///< Point, or start and end of a line; world, metres.
  /// Sum of squares; infinite if a factor is undefined at the start.
  double cost = std::numeric_limits<double>::infinity();
};

/// Minimises over the landmark from the value `start` on, or evaluates it there if it is `fixed`.
/// The end points of lines move across the line. Directions whose standard deviation by
/// the geometry of the views is a large part of the distance are held.
///
/// That geometry is computed with the normals of the projected line, not of the observed segments:
/// all views of a line along the motion of the camera show one interpretation plane, but noise, and
/// all the more one outlier, tilts the observed normals so that the line seems to be determined in
/// the plane. It would follow until it passes through the camera of the outlier, where it projects
/// to a point on any segment.
template <int Points>
LandmarkFit<Points> FitLandmark(const PinholeCamera& camera,
                                const std::vector<LandmarkView<Points>>& views,
                                const Eigen::Matrix<double, 3 * Points, 1>& start, bool fixed);

/// Largest standard deviation of the landmark by the geometry of the views, with known poses, of a
/// line across itself, divided by the distance from the nearest camera. Infinite where a direction
/// is not determined at all.
template <int Points>
double RelativeSigma(const PinholeCamera& camera, const std::vector<LandmarkView<Points>>& views,
                     const Eigen::Matrix<double, 3 * Points, 1>& landmark);

}  // namespace msc_vo
