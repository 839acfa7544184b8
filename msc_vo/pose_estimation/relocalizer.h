// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>
#include <string>

#include "msc_vo/map/map.h"
#include "msc_vo/matching/frame_matches.h"

namespace msc_vo {

struct RelocalizerOptions {
  /// Bits between descriptors; stricter than for matching by projection, where the predicted
  /// position excludes most wrong candidates.
  int max_distance = 64;
  double max_ratio = 0.8;  ///< best over second best descriptor distance
  /// RANSAC iterations: with 30 % inliers, 200 triples contain a clean one with 99.6 % probability.
  int max_iterations = 200;
  int min_inliers = 12;  ///< more than chance yields among some hundred wrong matches
  /// Reprojection error of an inlier, sigmas: square root of the 99 % quantile of chi-square with
  /// two degrees of freedom.
  double inlier_sigmas = 3.035;

  bool IsValid(std::string* error) const;
};

struct Relocalization {
  Rigid3 cam_from_world;
  FrameMatches matches;  ///< with landmarks; all of them are inliers
};

/// Finds the pose of `frame` from the landmarks of one keyframe without a prediction: descriptor
/// matching, then RANSAC over triples of 3-D/3-D correspondences, scored by reprojection.
/// Deterministic: the random numbers are seeded with the frame's id. Returns std::nullopt if too
/// few correspondences agree.
std::optional<Relocalization> Relocalize(const RelocalizerOptions& options, const Frame& frame,
                                         const Map& map, const Keyframe& keyframe);

}  // namespace msc_vo
