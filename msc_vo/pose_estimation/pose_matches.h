// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include "msc_vo/bundle_adjustment/observation.h"
#include "msc_vo/pose_estimation/pose_factors.h"
#include "msc_vo/pose_estimation/pose_optimization.h"

namespace msc_vo {

/// The factors of every match that are active in a round of motion-only bundle adjustment.
struct PoseInlierMask {
  std::vector<InlierMask> points;  ///< one per point of PoseData
  std::vector<InlierMask> lines;   ///< one per line of PoseData
  bool operator==(const PoseInlierMask& other) const {
    return points == other.points && lines == other.lines;
  }
};

/// Initial mask: every match in front of the camera is active.
PoseInlierMask AllInFront(const PoseOptions& options, const PoseData& data, const Rigid3& pose);

/// Chi-square test of every match over the enabled terms, outliers of earlier rounds included, with
/// limits that are inflated by the noise of the frame (PoseOptions::max_frame_noise). Matches on
/// dynamic objects are inactive.
PoseInlierMask ClassifyMatches(PoseOptions options, const PoseData& data, const Rigid3& pose);

/// Squared distance of a match from its landmark in the image, in sigmas of the observation;
/// infinite if the landmark is behind the camera.
double PixelChiSquare(const PinholeCamera& camera, const Rigid3& pose,
                      const PoseData::Point& point);
double PixelChiSquare(const PinholeCamera& camera, const Rigid3& pose, const PoseData::Line& line);

/// Ratio of the median of squared residuals of two rows each to that of chi-square with two degrees
/// of freedom. 1 for fewer than ten, which determine no ratio.
double MedianChiSquareRatio(std::vector<double> chi2);

/// Adds the active factors of one match. Sigmas of lines are evaluated at `pose`.
void AddFactors(const PoseOptions& options, const PinholeCamera& camera,
                const PoseData::Point& point, const InlierMask& mask, PoseFactors* factors);
void AddFactors(const PoseOptions& options, const PinholeCamera& camera, const PoseData::Line& line,
                const InlierMask& mask, const Rigid3& pose, PoseFactors* factors);
/// Sets the Huber thresholds of all terms.
void SetLosses(const PoseOptions& options, PoseFactors* factors);

/// The factors of all active matches, with the robust losses or without, and the custom factors.
PoseFactors BuildFactors(const PoseOptions& options, const PoseData& data,
                         const PoseInlierMask& mask, const Rigid3& pose, bool robust);

}  // namespace msc_vo
