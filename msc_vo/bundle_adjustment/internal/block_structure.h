// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <type_traits>
#include <vector>

#include "msc_vo/bundle_adjustment/internal/window_terms.h"

namespace msc_vo {

/// The factors of one observation, null where they are not used.
template <typename Reprojection, typename Depth>
struct ObservationFactors {
  int keyframe = 0;  ///< Positions in the state.
  int landmark = 0;
  int block = -1;  ///< Pose-landmark block; -1: the pose or the landmark is constant.
  const Reprojection* reprojection = nullptr;
  const Depth* depth = nullptr;

  /// As in CameraFactor; the same for both factors.
  Eigen::Vector3d PointInWorld(int k, const double* landmark_block) const {
    return reprojection != nullptr ? reprojection->PointInWorld(k, landmark_block)
                                   : depth->PointInWorld(k, landmark_block);
  }
  double Weight(int k, int i) const {
    return reprojection != nullptr ? reprojection->Weight(k, i) : depth->Weight(k, i);
  }
};
/// Whether a factor is one of an ObservationFactors, which are evaluated together.
template <typename Factor>
constexpr bool kIsOfObservation =
    std::is_same_v<Factor, PointReprojection> || std::is_same_v<Factor, DepthReprojection> ||
    std::is_same_v<Factor, LineReprojection> || std::is_same_v<Factor, LineDepthReprojection>;
using PointObservationFactors = ObservationFactors<PointReprojection, DepthReprojection>;
using LineObservationFactors = ObservationFactors<LineReprojection, LineDepthReprojection>;

/// Pose-landmark blocks of the Hessian: one for every pair of an unknown landmark and an unknown
/// pose that observes it, sorted by landmark.
struct PoseLandmarkBlocks {
  struct Range {
    int begin = 0;
    int size = 0;
    int end() const { return begin + size; }
  };
  std::vector<Range> of_landmark;  ///< Blocks of each unknown landmark.
  std::vector<int> pose;           ///< Unknown pose of each block.
};

/// Block structure of the Hessian of a window: numbering of the unknowns, and which of them share a
/// factor. Unknowns are the poses, landmarks and extra blocks that are not fixed and have a
/// residual block, numbered in the order of the data.
struct BlockStructure {
  BlockStructure(const WindowData& data, const WindowTerms& terms, const WindowState& state);

  /// Number of each keyframe, point and line of the data among the unknowns; -1: constant.
  std::vector<int> pose, point, line;
  int num_poses = 0, num_points = 0, num_lines = 0;

  std::vector<PointObservationFactors> point_observations;
  std::vector<LineObservationFactors> line_observations;
  PoseLandmarkBlocks point_blocks, line_blocks;

  /// Line-line blocks: pairs of two unknown lines, first parallel, then perpendicular ones.
  std::vector<WindowIndex::Pair> line_pairs;
  /// Number of each unknown line among those in the reduced system (LinesInReducedSystem); -1:
  /// eliminated.
  std::vector<int> reduced_line;
  int num_reduced_lines = 0;

  /// Number of each extra block of the state among the unknowns; -1: constant.
  std::vector<int> extra;
  std::vector<int> extra_size;  ///< Size of the tangent space of each unknown extra block.
  /// Parameter blocks of each custom factor: their kinds and their numbers among the unknowns.
  std::vector<std::vector<StateBlock>> custom_factors;

  /// First rows in the reduced system of unknowns that custom factors keep there because they
  /// couple them with other unknowns; -1: eliminated.
  /// Of points, of the coordinates of reduced lines other than the direction (ReducedLine), and of
  /// the tangent spaces of extra blocks.
  std::vector<int> point_row, position_row, extra_row;
  /// First rows of poses and of the directions of reduced lines.
  int PoseRow(int i) const { return 6 * i; }
  int DirectionRow(int i) const { return 6 * num_poses + 2 * i; }
  int reduced_size = 0;
  /// Computes the rows from the numbers above, which must not be changed without it.
  void AssignRows();

 private:
  int Number(const StateBlock& block) const;
  void NumberExtraBlocks(const WindowData& data, const WindowTerms& terms,
                         const WindowState& state);
  void NumberCustomFactors(const WindowTerms& terms);
  // Calls action(number) for every unknown of a kind that a custom factor couples with another one.
  // A factor with one unknown adds to the block of that unknown alone, which can be eliminated.
  template <typename Action>
  void ForEachCoupledUnknown(BlockKind kind, const Action& action) const;
};

}  // namespace msc_vo
