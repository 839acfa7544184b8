// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include "msc_vo/frame/plane_feature.h"
#include "msc_vo/geometry/pose_covariance.h"
#include "msc_vo/geometry/rigid3.h"
#include "msc_vo/map/plane_landmark.h"

namespace msc_vo {

/// Matches the planes of a frame with those of the map by their geometry, from a pose with a
/// covariance (tangent of Rigid3Manifold): a feature is the likeliest plane that it does not
/// contradict (chi-square), among those whose extent it touches if there are such. Parts of one
/// wall are matched with the same plane.
std::vector<PlaneMatch> MatchPlanes(const std::vector<PlaneFeature>& features, const MapPlanes& map,
                                    const Rigid3& cam_from_world, const PoseCovariance& covariance);

/// The covariance (tangent of Rigid3Manifold) to match planes with, at a pose that was estimated
/// from points and lines with a stated one: three times its sigmas, and at least 0.3 degrees and 3
/// mm, because few points state too little.
PoseCovariance CovarianceForMatching(const Rigid3& cam_from_world, const PoseCovariance& stated);

/// Whether two planes, in the camera frame, differ by less than three sigmas of a feature that
/// observes one of them: where it was seen, and at the vertices of both extents, whose depth is
/// taken to be known as well as that of the feature. `noise`: MapPlanes::noise.
bool AreSamePlane(const PlaneFeature& feature, const PlaneLandmark& a, const PlaneLandmark& b,
                  double noise);

/// Projection onto the translations of the camera, in its frame, that planes with these normals
/// leave free.
Eigen::Matrix3d FreeTranslations(const std::vector<PlaneFeature>& features);

/// Whether planes with these normals determine a pose: their normals span three directions.
inline bool DetermineAPose(const std::vector<PlaneFeature>& features) {
  return FreeTranslations(features).isZero();
}

}  // namespace msc_vo
