// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/geometry/pose_covariance.h"
#include "msc_vo/geometry/rigid3.h"
#include "msc_vo/map/map.h"

namespace msc_vo {

/// How uncertain the motion between two keyframes is, as odometry has measured it along the path
/// between them: each keyframe adds the error of its own pose (Map::SetStepCovariance), and each
/// metre that of the calibration.
///
/// Returns the covariance of the pose of keyframe `b` relative to `a` in the frame of `b`: of the
/// camera itself, as by CameraCovariance(). Both are or were in the map, in any order.
PoseCovariance PathCovariance(const Map& map, KeyframeId a, KeyframeId b);

/// Whether odometry can have erred so much between keyframe `a` and a camera near keyframe `b`, by
/// a chi-square test. `by_path`: pose of the camera relative to `a` by odometry. `measured`: the
/// same pose by other means. `covariance`: of both apart from the path, in the camera frame.
bool IsPossibleDrift(const Map& map, KeyframeId a, KeyframeId b, const Rigid3& by_path,
                     const Rigid3& measured, const PoseCovariance& covariance);

}  // namespace msc_vo
