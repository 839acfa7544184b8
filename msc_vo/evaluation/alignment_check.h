// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "msc_vo/geometry/rigid3.h"

namespace msc_vo {

// Checks of matched poses: the i-th pose of both vectors is of the same time, camera in world. The
// vectors must have the same size.

/// Whether all positions are the same up to rounding.
bool IsStatic(const std::vector<Rigid3>& poses);

/// Describes what a rigid alignment, or a similarity, leaves undetermined: the rotation if a
/// trajectory does not move, or moves less than it is in error; the rotation about a straight line.
/// A wrong scale is no error of the positions, see DescribeScaleContradiction(): the test scales
/// the estimate, while the error that is stated is that of the alignment, scaled only if
/// `with_scale`. Empty if the alignment is determined.
std::string DescribeUndetermined(const std::vector<Rigid3>& reference,
                                 const std::vector<Rigid3>& estimate, bool with_scale);

/// Describes a scale of the estimate that clearly contradicts the reference, as wrong units of
/// depth cause; empty if there is none. The path is divided into parts of equal length, which are
/// aligned by themselves. The mean of their logarithmic scales must exceed what depth sensors err
/// by, according to a t-test at 99.9 %: a trajectory that was lost has parts that differ. In each
/// part, the scale counts that is closest to 1 between the regression of the reference on the
/// estimate and that of the estimate on the reference, so that noise makes no scale.
std::string DescribeScaleContradiction(const std::vector<Rigid3>& reference,
                                       const std::vector<Rigid3>& estimate);

/// Names angle and axis of a rotation: "180 degree turn about x", "120 degree turn about (0.58,
/// -0.58, 0.58)".
std::string DescribeTurn(const Eigen::Matrix3d& rotation);

/// Describes why orientations contradict each other; empty if they agree or nothing explains it.
/// The poses of one trajectory are inverse; or the camera axes of both differ by a constant
/// rotation, such as those of OpenGL (x right, y up, z back), or as if the images were mirrored; or
/// the scalar of one trajectory's quaternions is at the other end of the four numbers. Read so,
/// orientations must nearly agree. `estimate_is_own`: the estimate is a trajectory of msc_vo, so
/// that only the reference can be at fault.
std::string DescribeOrientationContradiction(const std::vector<Rigid3>& reference,
                                             const std::vector<Rigid3>& estimate,
                                             bool estimate_is_own);

}  // namespace msc_vo
