// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>
#include <vector>

#include "msc_vo/bundle_adjustment/custom_factor.h"
#include "msc_vo/frame/plane_feature.h"
#include "msc_vo/map/plane_landmark.h"
#include "msc_vo/pose_estimation/pose_factor.h"

namespace msc_vo {

/// What determines a pose beside planes. Errors of the calibration tilt planes as they have tilted
/// those of the map, so that only points and lines contradict them: beside these, factors count
/// such errors.
enum class PlanesBeside { kPointsAndLines, kNothing };

/// Factors over the pose of a frame: its matched planes, those of the map held fixed
/// (PlaneObservation). Matches with planes that are no longer in the map are left out.
std::vector<PoseFactor> MakePlanePoseFactors(const std::vector<PlaneFeature>& features,
                                             const std::vector<PlaneMatch>& matches,
                                             const MapPlanes& map, PlanesBeside beside);

/// The factor of a window between a keyframe and the extra block of a plane of the map, with
/// PlaneManifold, beside points and lines. `noise`: MapPlanes::noise.
CustomFactor MakePlaneFactor(const PlaneFeature& feature, double noise, const BlockId& pose,
                             const BlockId& plane);

/// A plane as a frame with a known pose sees it.
struct PlaneView {
  Rigid3 cam_from_world;  ///< metres
  const PlaneFeature* feature = nullptr;
};

/// Fits a plane (world, metres) to what frames see of it, beginning at *plane. `noise`:
/// MapPlanes::noise. Frames that the plane is behind take no part.
void FitPlane(const std::vector<PlaneView>& views, double noise, Plane* plane);

}  // namespace msc_vo
