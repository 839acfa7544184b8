// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include "msc_vo/bundle_adjustment/internal/window_equations.h"

namespace msc_vo {

/// Diagonal damping D / radius of Levenberg-Marquardt, D = diag H. D is bounded as in Ceres, so
/// that an unconstrained parameter is damped too.
template <int N>
Eigen::Matrix<double, N, 1> Damping(const Eigen::Matrix<double, N, N>& hessian, double radius) {
  constexpr double kMinDiagonal = 1e-6, kMaxDiagonal = 1e32;
  return hessian.diagonal().cwiseMax(kMinDiagonal).cwiseMin(kMaxDiagonal) / radius;
}

/// Block W of the Hessian between N eliminated parameters and the direction of a line in the
/// reduced system.
template <int N>
struct DirectionCoupling {
  int row = 0;  ///< First of the direction's two rows in the reduced system.
  Eigen::Matrix<double, 2, N> block;
};

/// N eliminated parameters x with damped Hessian H: H x = -(gradient + sum_i W_i^T y_i), where y_i
/// are parts of the reduced system's solution.
template <int N>
struct EliminatedBlock {
  Eigen::Matrix<double, N, N> inverse;  ///< H^-1.
  Eigen::Matrix<double, N, 1> gradient;
  /// Blocks W_i of the poses, and the numbers of the poses.
  const Eigen::Matrix<double, 6, N>* pose_couplings = nullptr;
  const int* poses = nullptr;
  int num_poses = 0;
  std::vector<DirectionCoupling<N>> direction_couplings;
};

/// A line with its direction in the reduced system. In the coordinates basis^T (S, E), the last two
/// (direction) stay; the first four (position and length) are eliminated, unless a custom factor
/// keeps them in the reduced system too.
struct ReducedLine {
  Eigen::Matrix<double, 6, 6> basis;  ///< Orthonormal columns.
  int row = 0;                        ///< First row of the direction in the reduced system.
  int position_row = -1;              ///< First row of the position; -1: eliminated.
  EliminatedBlock<4> position;
  std::vector<Eigen::Matrix<double, 6, 4>> pose_couplings;  ///< Those of `position`.

  /// Derivative of E - S with respect to the direction's coordinates.
  Eigen::Matrix<double, 3, 2> DirectionBasis() const {
    return basis.bottomRightCorner<3, 2>() - basis.topRightCorner<3, 2>();
  }
};

/// Schur complement of the damped normal equations (H + D / radius) step = -gradient after
/// elimination of the landmarks. The reduced system has six unknowns per pose, then two per line in
/// the reduced system: structural pairs couple lines only by their directions, so the other four
/// parameters of every line are eliminated. Last come the extra blocks, and the points and
/// positions of lines that custom factors depend on.
///
/// Refers to `structure` and `equations`, which must outlive it.
class SchurComplement {
 public:
  SchurComplement(const BlockStructure& structure, const WindowEquations& equations, double radius);
  SchurComplement(const SchurComplement&) = delete;
  SchurComplement& operator=(const SchurComplement&) = delete;

  /// Solves the reduced system, or computes the inverse of its matrix. Returns false if the matrix
  /// is not positive definite. Both factorise the matrix in place: call one of them, once.
  bool Solve(Eigen::VectorXd* solution);
  bool Invert(Eigen::MatrixXd* inverse);

  /// By number of the unknown point or line. A line with reduced_line >= 0 is in reduced_lines().
  const std::vector<EliminatedBlock<3>>& points() const { return points_; }
  const std::vector<EliminatedBlock<6>>& lines() const { return lines_; }
  const std::vector<ReducedLine>& reduced_lines() const { return reduced_lines_; }

 private:
  void AddPoses();
  void EliminatePoints();
  void KeepPoint(const EliminatedBlock<3>& point, const Eigen::Matrix3d& hessian, int row);
  void AddExtraBlocks();
  void AddCustomCouplings();
  void AddLineCouplings();
  void EliminateLines();
  void ReduceLine(const EliminatedBlock<6>& line, const Eigen::Matrix<double, 6, 6>& hessian,
                  ReducedLine* reduced);
  void KeepPosition(const Eigen::Matrix<double, 6, 6>& hessian,
                    const Eigen::Matrix<double, 6, 1>& gradient, const EliminatedBlock<6>& line,
                    const ReducedLine& reduced);
  template <int N>
  void Eliminate(const EliminatedBlock<N>& block);

  const BlockStructure& structure_;
  const WindowEquations& equations_;
  const double radius_;
  Eigen::MatrixXd matrix_;  // lower triangle
  Eigen::VectorXd right_;
  std::vector<EliminatedBlock<3>> points_;
  std::vector<EliminatedBlock<6>> lines_;
  std::vector<ReducedLine> reduced_lines_;
};

}  // namespace msc_vo
