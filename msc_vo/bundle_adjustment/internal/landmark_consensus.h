// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include "msc_vo/bundle_adjustment/internal/window_terms.h"

namespace msc_vo {

/// Search for gross errors in the observations of each landmark (data snooping, Baarda 1968).
///
/// A landmark with few views follows an outlier, so that the residuals at the solution do not show
/// it. But the sum of squares c of its observations drops by
///
///   T_i = c - c(without observation i)
///
/// if outlier i is left out and the landmark fitted again (FitLandmark). For an inlier, T_i is
/// chi-square distributed with the rows of the observation. The observation whose T_i exceeds its
/// limit most is rejected, or only its depth if that suffices, and the search repeated with the
/// rest. If a search that rejected any leaves no more than half of the observations, or not more
/// rows than degrees of freedom, it rejects all.
///
/// Poses are held at `state`. Fits start at the landmarks of `data`, where the outlier has not
/// moved them to. Overwrites the observations of *inlier_mask, without those behind the camera. A
/// free landmark of *state takes the fitted value if an observation was rejected, or if the views
/// do not determine it (FindDetermined); those of relations and custom factors, which the fit
/// ignores, keep theirs.
void FindConsensus(const BundleAdjustmentOptions& options, const WindowIndex& index,
                   const WindowData& data, WindowState* state, WindowInlierMask* inlier_mask);

/// Landmarks whose position the inliers determine.
struct DeterminedLandmarks {
  std::vector<bool> points, lines;  ///< One per landmark.
};

/// Standard deviation over distance from which on a landmark is not determined: the interval of
/// three standard deviations contains the camera or infinity, and no covariance describes the
/// position.
constexpr double kMaxRelativeSigma = 1.0 / 3.0;

/// Finds the landmarks that the geometry of their inlier views determines to kMaxRelativeSigma,
/// with known poses. Fixed landmarks and those of relations and custom factors count as determined.
DeterminedLandmarks FindDetermined(const BundleAdjustmentOptions& options, const WindowIndex& index,
                                   const WindowData& data, const WindowInlierMask& inlier_mask,
                                   const WindowState& state);

}  // namespace msc_vo
