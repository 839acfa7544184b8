// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include "msc_vo/bundle_adjustment/internal/block_structure.h"

namespace msc_vo {

/// Normal equations of a window, H step = -gradient, in the blocks of BlockStructure. H is the
/// Gauss-Newton Hessian of the robust cost: the J^T J of each factor, weighted by the derivative of
/// its loss. Steps of poses are in the tangent space of Rigid3Manifold, those of points and of the
/// end points of lines in metres.
struct WindowEquations {
  template <int N>
  struct Landmarks {
    using Block = Eigen::Matrix<double, N, N>;
    using Vector = Eigen::Matrix<double, N, 1>;
    using Coupling = Eigen::Matrix<double, 6, N>;
    std::vector<Block> hessian;
    std::vector<Vector> gradient;
    std::vector<Coupling> pose_couplings;  ///< One per pose-landmark block.
  };
  using Pose = Landmarks<6>;

  std::vector<Pose::Block> pose_hessian;
  std::vector<Pose::Vector> pose_gradient;
  Landmarks<3> points;
  Landmarks<6> lines;
  /// One per line-line block, with respect to the vectors E - S of both lines.
  std::vector<Eigen::Matrix3d> line_couplings;
  std::vector<Eigen::Vector3d> directions;  ///< Unit directions of the unknown lines.

  /// Extra blocks, in their tangent spaces.
  std::vector<Eigen::MatrixXd> extra_hessian;
  std::vector<Eigen::VectorXd> extra_gradient;
  /// Block of H between two unknowns of a custom factor. Positions are numbers of unknowns.
  struct CustomCoupling {
    StateBlock row, col;
    Eigen::MatrixXd block;
  };
  std::vector<CustomCoupling> custom_couplings;
  double cost = 0.0;
};

/// Evaluates all factors and their derivatives at `state`. Returns false if a factor is undefined
/// there or the cost is not finite, as behind a camera or for a line of zero length (see TakeStep).
bool Linearize(const BlockStructure& structure, const WindowTerms& terms, const WindowState& state,
               WindowEquations* equations);

}  // namespace msc_vo
