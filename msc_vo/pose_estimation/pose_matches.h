// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include "msc_vo/bundle_adjustment/observation.h"
#include "msc_vo/pose_estimation/pose_factors.h"
#include "msc_vo/pose_estimation/pose_optimization.h"

namespace msc_vo {

/// The factors that are active in a round of motion-only bundle adjustment, one mask per match of
/// PoseData.
using PoseInlierMask = PerKind<std::vector<InlierMask>>;

/// Initial mask: every match in front of the camera is active.
PoseInlierMask AllInFront(const PoseOptions& options, const PoseData& data, const Rigid3& pose);

/// Chi-square test of every match over the enabled terms, outliers of earlier rounds included, with
/// limits that are inflated by the noise of the frame (PoseOptions::max_frame_noise). Matches on
/// dynamic objects are inactive.
PoseInlierMask ClassifyMatches(PoseOptions options, const PoseData& data, const Rigid3& pose);

/// Squared distance of a match from its landmark in the image, in sigmas of the observation;
/// infinite if the landmark is behind the camera.
template <typename Match>
double PixelChiSquare(const PinholeCamera& camera, const Rigid3& pose, const Match& match) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const auto in_cam = InCamera(pose, match);
  if (!IsInFront(in_cam)) return kInfinity;
  const double chi2 = PixelChiSquare(camera, match, in_cam);
  // NaN, from a sigma whose inverse overflows, cannot be sorted.
  return std::isnan(chi2) ? kInfinity : chi2;
}

/// Ratio of the median of squared residuals of two rows each to that of chi-square with two degrees
/// of freedom. 1 for fewer than ten, which determine no ratio.
double MedianChiSquareRatio(std::vector<double> chi2);

/// Sets the Huber thresholds of all terms.
void SetLosses(const PoseOptions& options, PoseFactors* factors);

/// The factors of all active matches, with the robust losses or without, and the custom factors.
PoseFactors BuildFactors(const PoseOptions& options, const PoseData& data,
                         const PoseInlierMask& mask, const Rigid3& pose, bool robust);

}  // namespace msc_vo
