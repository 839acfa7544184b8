// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <tuple>
#include <vector>

#include "msc_vo/bundle_adjustment/levenberg_marquardt.h"
#include "msc_vo/factors/camera_factor.h"
#include "msc_vo/factors/depth_reprojection.h"
#include "msc_vo/factors/line_depth_reprojection.h"
#include "msc_vo/factors/line_reprojection.h"
#include "msc_vo/factors/point_reprojection.h"
#include "msc_vo/geometry/rigid3.h"
#include "msc_vo/pose_estimation/pose_factor.h"

namespace msc_vo {

/// J^T J, J^T r and half the sum of robust squared norms at one pose, in the tangent space of
/// Rigid3Manifold.
struct NormalEquations {
  Eigen::Matrix<double, 6, 6> hessian = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix<double, 6, 1> gradient = Eigen::Matrix<double, 6, 1>::Zero();
  double cost = 0.0;
};

/// All factors of one type; the map is constant.
template <typename Factor>
struct PoseTerm {
  struct Block {
    Factor factor;
    Eigen::Matrix<double, 3 * Factor::kNumPoints, 1> landmark;  ///< World, metres.
  };
  double huber = 0.0;  ///< Huber threshold in standard deviations; 0: no loss.
  std::vector<Block> blocks;

  int NumRows() const { return static_cast<int>(blocks.size()) * Factor::kNumResiduals; }
  /// Adds to the lower triangle of the Hessian only. Returns false if a point is behind the camera.
  bool AddTo(const Rigid3& cam_from_world, NormalEquations* sum) const;
  /// Adds only the cost, with the same rounding.
  bool AddCostTo(const Rigid3& cam_from_world, double* sum) const;
};

/// Factors of one round of pose optimization, i.e. motion-only bundle adjustment (paper Eq.
/// poseest).
///
/// The normal equations have six unknowns and are accumulated here rather than in Ceres, whose
/// overhead per residual block exceeds the cost of the factors (docs/lab/tracking.md). A test
/// compares them with Ceres.
struct PoseFactors {
  /// In the order in which they are added.
  std::tuple<PoseTerm<PointReprojection>, PoseTerm<DepthReprojection>, PoseTerm<LineReprojection>,
             PoseTerm<LineDepthReprojection>>
      terms;
  std::vector<PoseFactor> custom;

  template <typename Factor>
  PoseTerm<Factor>& Of() {
    return std::get<PoseTerm<Factor>>(terms);
  }
  template <typename Factor>
  const PoseTerm<Factor>& Of() const {
    return std::get<PoseTerm<Factor>>(terms);
  }

  int NumRows() const;
  /// Removes the factors; losses and allocated memory remain.
  void Clear();
  /// Evaluate the normal equations or the cost alone, with the same rounding. Return false if a
  /// point is behind the camera, or if a custom factor fails or is not finite.
  bool Linearize(const Rigid3& cam_from_world, NormalEquations* equations) const;
  bool Cost(const Rigid3& cam_from_world, double* cost) const;
};

/// Describes what is wrong with `factor` at the initial pose; empty if nothing is.
std::string PoseFactorError(const PoseFactor& factor, const Rigid3& cam_from_world);

/// Minimises the cost by Levenberg-Marquardt from *cam_from_world. Returns kFailed, and leaves the
/// pose unchanged, if a factor is undefined at the initial pose or a step is not finite.
LevenbergMarquardtTermination MinimizePose(const PoseFactors& factors, int max_iterations,
                                           Rigid3* cam_from_world);

}  // namespace msc_vo
