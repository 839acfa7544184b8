// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "msc_vo/geometry/pose_covariance.h"
#include "msc_vo/geometry/rigid3.h"

namespace msc_vo {

/// The pose of one frame in two maps.
struct FrameInTwoMaps {
  Rigid3 cam_from_a;
  Rigid3 cam_from_b;
  PoseCovariance covariance_a = PoseCovariance::Zero();
  PoseCovariance covariance_b = PoseCovariance::Zero();
};

struct MapAlignmentOptions {
  /// Frames that must agree on the alignment. Two may err in the same way; one cannot be checked.
  int min_frames = 3;
  /// Standard deviations of a pose that its covariance lacks, because that holds the landmarks for
  /// exact: the error of a map within one view.
  double map_sigma = 0.01;          ///< metres
  double map_rotation_sigma = 0.3;  ///< degrees
  /// 99 % quantile of chi-square with six degrees of freedom.
  double reject_chi2_6 = 16.812;

  bool IsValid(std::string* error) const;
};

struct MapAlignment {
  Rigid3 a_from_b;  ///< world to world
  /// Not smaller than that of a single frame, because the errors of the landmarks are common to all
  /// frames.
  PoseCovariance covariance = PoseCovariance::Zero();
  std::vector<bool> inliers;  ///< one per frame: agrees with the alignment
};

/// Aligns the worlds of two maps rigidly by frames whose poses are known in both: the alignment of
/// the frame that most others agree with, then least squares over those. std::nullopt if fewer than
/// `min_frames` agree, or not more than half of the frames.
std::optional<MapAlignment> AlignMaps(const MapAlignmentOptions& options,
                                      const std::vector<FrameInTwoMaps>& frames);

}  // namespace msc_vo
