// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include "msc_vo/bundle_adjustment/window_data.h"

namespace msc_vo {

/// Parameter block of a WindowState: a keyframe, point, line or extra block by its position in the
/// data. The Manhattan axes are an extra block, behind those of the data (never kAxes).
struct StateBlock {
  BlockKind kind = BlockKind::kPose;
  int position = 0;

  bool operator==(const StateBlock& other) const {
    return kind == other.kind && position == other.position;
  }
};

/// Whether a block of the data is held constant.
bool IsFixed(const WindowData& data, const StateBlock& block);

/// Parameter blocks of a window during minimisation: points (3 numbers each), lines (6), poses (7),
/// and extra blocks, in one buffer.
///
/// Ceres eliminates the blocks of a group in the order of their addresses. One buffer makes that
/// order, and with it the rounding of sums, the same in every run.
class WindowState {
 public:
  explicit WindowState(const WindowData& data);

  /// Parameter block of point, line, keyframe or extra block i.
  double* PointBlock(size_t i) { return &parameters_[3 * i]; }
  double* LineBlock(size_t i) { return &parameters_[lines_ + 6 * i]; }
  double* PoseBlock(size_t i) { return &parameters_[poses_ + 7 * i]; }
  double* ExtraBlock(size_t i) { return &parameters_[extra_[i].offset]; }
  const double* PointBlock(size_t i) const { return &parameters_[3 * i]; }
  const double* LineBlock(size_t i) const { return &parameters_[lines_ + 6 * i]; }
  const double* PoseBlock(size_t i) const { return &parameters_[poses_ + 7 * i]; }
  const double* ExtraBlock(size_t i) const { return &parameters_[extra_[i].offset]; }
  double* Block(const StateBlock& block) {
    return const_cast<double*>(static_cast<const WindowState*>(this)->Block(block));
  }
  const double* Block(const StateBlock& block) const;

  /// Current value of point, line, keyframe pose or extra block i.
  Eigen::Vector3d Point(size_t i) const { return Eigen::Vector3d(PointBlock(i)); }
  LineSegment3 Line(size_t i) const {
    const double* block = LineBlock(i);
    return {Eigen::Vector3d(block), Eigen::Vector3d(block + 3)};
  }
  Rigid3 Pose(size_t i) const {
    Rigid3 pose;
    pose.params = Eigen::Matrix<double, 7, 1>(PoseBlock(i));
    return pose;
  }
  Eigen::Map<const Eigen::VectorXd> Extra(size_t i) const {
    return {ExtraBlock(i), extra_[i].size};
  }

  /// Number of extra blocks, including the Manhattan axes if the window has any.
  size_t NumExtra() const { return extra_.size(); }
  /// Number of parameters and of degrees of freedom of a block.
  int Size(const StateBlock& block) const;
  int TangentSize(const StateBlock& block) const;
  /// Manifold of a block; nullptr: Euclidean.
  const ceres::Manifold* ManifoldOf(const StateBlock& block) const;

  bool AllFinite() const {
    for (const double x : parameters_) {
      if (!std::isfinite(x)) return false;
    }
    return true;
  }

 private:
  struct ExtraEntry {
    size_t offset;
    int size;
    const ceres::Manifold* manifold;
  };
  void AppendExtra(const double* value, int size, const ceres::Manifold* manifold);

  size_t lines_;  // offset of the first line
  size_t poses_;  // offset of the first pose
  std::vector<ExtraEntry> extra_;
  std::vector<double> parameters_;
};

/// Writes the blocks for which is_written(block) holds to the data that the state was made of.
void WriteState(const WindowState& state, const std::function<bool(const StateBlock&)>& is_written,
                WindowData* data);

}  // namespace msc_vo
