// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "msc_vo/factors/block_kind.h"

namespace ceres {
class CostFunction;
class LossFunction;
class Manifold;
}  // namespace ceres

namespace msc_vo {

/// Identifies a parameter block of a window by its kind and id.
struct BlockId {
  using Kind = BlockKind;
  Kind kind = Kind::kPose;
  int64_t id = 0;

  static BlockId Pose(int64_t keyframe) { return {Kind::kPose, keyframe}; }
  static BlockId Point(int64_t point) { return {Kind::kPoint, point}; }
  static BlockId Line(int64_t line) { return {Kind::kLine, line}; }
  static BlockId Axes() { return {Kind::kAxes, 0}; }
  static BlockId Extra(int64_t extra) { return {Kind::kExtra, extra}; }

  bool operator==(const BlockId& other) const { return kind == other.kind && id == other.id; }
  bool operator!=(const BlockId& other) const { return !(*this == other); }
};

/// A parameter block of the caller's own, such as the scale of a wheel odometry, the bias of a
/// gyroscope or a lever arm. CustomFactors give it a meaning.
struct ExtraBlock {
  int64_t id = 0;                                             ///< unique among the extra blocks
  Eigen::VectorXd value;                                      ///< in: initial value, out: estimate
  std::shared_ptr<const ceres::Manifold> manifold = nullptr;  ///< null: Euclidean
  bool fixed = false;

  template <typename Archive>
  void Serialize(Archive& archive) {
    archive(id, value, fixed);  // the manifold belongs to the code of the caller
  }
};

/// A residual block of the caller's own: any Ceres cost function (automatic, analytic or numeric
/// derivatives) over blocks of the window. Its residual must be whitened, i.e. divided by its
/// standard deviation. Steps of poses are in the tangent space of Rigid3Manifold, those of axes in
/// that of Rotation3Manifold.
struct CustomFactor {
  std::string name;  ///< for error messages
  std::shared_ptr<const ceres::CostFunction> cost;
  std::shared_ptr<const ceres::LossFunction> loss;  ///< null: none
  std::vector<BlockId> blocks;                      ///< one per parameter block of `cost`
};

}  // namespace msc_vo
