// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>
#include <vector>

#include "msc_vo/geometry/pose_covariance.h"
#include "msc_vo/geometry/rigid3.h"

namespace msc_vo {

/// The pose of one frame in two maps, with its covariances in the camera frame
/// (CameraCovariance()).
struct FrameInTwoMaps {
  Rigid3 cam_from_a;
  Rigid3 cam_from_b;
  PoseCovariance covariance_a = PoseCovariance::Zero();
  PoseCovariance covariance_b = PoseCovariance::Zero();
};

/// Covariance that a pose in a map lacks, because its own holds the landmarks for exact: the error
/// of a map within one view, 10 mm and 0.3 degrees (docs/lab/segments.md), in the camera frame.
PoseCovariance ViewCovariance();

/// Frames that must agree on an alignment. Two may err in the same way; one cannot be checked.
constexpr int kMinAlignedFrames = 3;

struct MapAlignment {
  Rigid3 a_from_b;  ///< world to world
  /// Not smaller than that of a single frame, because the errors of the landmarks are common to all
  /// frames.
  PoseCovariance covariance = PoseCovariance::Zero();
  std::vector<bool> inliers;  ///< one per frame: agrees with the alignment
};

/// Aligns the worlds of two maps rigidly by frames whose poses are known in both: the alignment of
/// the frame that most others agree with, then least squares over those. std::nullopt if fewer than
/// kMinAlignedFrames agree, or not more than half of the frames.
std::optional<MapAlignment> AlignMaps(const std::vector<FrameInTwoMaps>& frames);

}  // namespace msc_vo
