// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

namespace msc_vo {

enum class DeltaUnit { kFrames, kMetres, kSeconds };

/// Distance between the two poses of a relative pose error (RPE). Frames and metres are defined as
/// in the program evo, so that the numbers are the same.
struct RelativeDelta {
  double value = 1.0;  ///< in `unit`; whole for frames
  DeltaUnit unit = DeltaUnit::kFrames;
  /// False: consecutive pairs, each of which begins where the one before ends. True: a pair begins
  /// at every pose.
  bool all_pairs = false;

  /// What `value` must be and is not: positive, and whole and at most 1e9 if it counts frames.
  /// Empty if it is valid.
  std::string Problem() const;
};

/// Returns the pairs of indices (i, j), i < j, of poses that are `delta` apart.
///
/// - Frames: j = i + delta.
/// - Metres, along the path of `positions`: consecutive pairs connect the poses at which the path
///   since the last of them, or since the first pose, reaches delta. Of all pairs, j is the pose
///   whose path from i is closest to delta; a pair that is off by more than a tenth of delta is
///   left out.
/// - Seconds: j is the pose whose stamp is closest to that of i plus delta, at most `tolerance`
///   seconds off.
///
/// Both lists have one entry per pose, stamps in ascending order, in seconds and metres.
std::vector<std::pair<int, int>> FindRelativePairs(const std::vector<double>& stamps,
                                                   const std::vector<Eigen::Vector3d>& positions,
                                                   const RelativeDelta& delta, double tolerance);

/// Length of the path from the first position to each position, metres.
std::vector<double> PathLengths(const std::vector<Eigen::Vector3d>& positions);

}  // namespace msc_vo
