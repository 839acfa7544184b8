// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>

#include "msc_vo/geometry/pose_covariance.h"
#include "msc_vo/pose_estimation/pose_factors.h"
#include "msc_vo/pose_estimation/pose_matches.h"

namespace msc_vo {

/// Covariance of the pose that minimises the cost of the inliers of `mask`; `at_pose` are the
/// normal equations H dx = -g of their factors there. std::nullopt if H is numerically singular.
///
/// The estimate weighs every observation by its own covariance S, but the residual also contains
/// the error of the landmark, (1 + v) S in total, where v is PoseData::Point::map_variance. The
/// covariance of such an estimate is
///
///   s^2 H^-1 (sum of (1 + v) J^T S^-1 J) H^-1
///
/// with the variance factor s^2, by which the residuals exceed what these covariances predict, at
/// least 1: those of the inliers by their mean square, or those in the image of all matches that
/// are not on dynamic objects by their median, whichever is larger. If more than half of ten or
/// more matches are outliers, the latter is large. With a map that is exact and residuals as
/// predicted the covariance is H^-1. Custom factors count as they are.
std::optional<PoseCovariance> CovarianceOfEstimate(const PoseOptions& options, const PoseData& data,
                                                   const PoseInlierMask& mask, const Rigid3& pose,
                                                   const NormalEquations& at_pose);

}  // namespace msc_vo
