// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/bundle_adjustment/internal/schur_complement.h"

#include <cmath>
#include <utility>

#include <Eigen/Cholesky>

namespace msc_vo {

namespace {

using Matrix6d = Eigen::Matrix<double, 6, 6>;
using Vector6d = Eigen::Matrix<double, 6, 1>;

// Orthonormal basis of a line's parameters (S, E) that separates its direction: translation (3),
// half the change of length (1), direction (2).
Matrix6d LineBasis(const Eigen::Vector3d& direction) {
  const double half = std::sqrt(0.5);
  const Eigen::Vector3d across = direction.unitOrthogonal();
  Eigen::Matrix3d axes;
  axes << direction, across, direction.cross(across);
  Matrix6d basis;
  basis.topLeftCorner<3, 3>().setIdentity();
  basis.bottomLeftCorner<3, 3>().setIdentity();
  basis.topRightCorner<3, 3>() = -axes;
  basis.bottomRightCorner<3, 3>() = axes;
  return half * basis;
}

// Sets the couplings of an eliminated landmark with the poses that observe it.
template <int N>
void SetPoses(const PoseLandmarkBlocks& blocks, const WindowEquations::Landmarks<N>& equations,
              int landmark, EliminatedBlock<N>* block) {
  const PoseLandmarkBlocks::Range& range = blocks.of_landmark[landmark];
  block->gradient = equations.gradient[landmark];
  block->pose_couplings = equations.pose_couplings.data() + range.begin;
  block->poses = blocks.pose.data() + range.begin;
  block->num_poses = range.size;
}

// Coordinates C^T x of the step x of an unknown, and their first row in the reduced system.
struct ReducedCoordinates {
  int row;
  Eigen::MatrixXd columns;  // C, orthonormal
};

// All coordinates of an unknown that is in the reduced system.
std::vector<ReducedCoordinates> CoordinatesOf(const BlockStructure& structure,
                                              const std::vector<ReducedLine>& reduced_lines,
                                              const StateBlock& unknown, Eigen::Index size) {
  const int i = unknown.position;
  switch (unknown.kind) {
    case BlockKind::kPose:
      return {{structure.PoseRow(i), Eigen::MatrixXd::Identity(size, size)}};
    case BlockKind::kPoint:
      return {{structure.point_row[i], Eigen::MatrixXd::Identity(size, size)}};
    case BlockKind::kAxes:
    case BlockKind::kExtra:
      return {{structure.extra_row[i], Eigen::MatrixXd::Identity(size, size)}};
    case BlockKind::kLine:
      break;
  }
  const ReducedLine& line = reduced_lines[structure.reduced_line[i]];
  return {{line.position_row, line.basis.leftCols<4>()}, {line.row, line.basis.rightCols<2>()}};
}

// Solves matrix x = right by an in-place Cholesky factorisation.
template <typename Right>
bool SolveInPlace(const Right& right, Eigen::MatrixXd* matrix, Right* x) {
  if (matrix->rows() == 0) {
    *x = right;
    return true;
  }
  const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> cholesky(*matrix);
  if (cholesky.info() != Eigen::Success) return false;
  *x = cholesky.solve(right);
  return true;
}

}  // namespace

SchurComplement::SchurComplement(const BlockStructure& structure, const WindowEquations& equations,
                                 double radius)
    : structure_(structure), equations_(equations), radius_(radius) {
  matrix_.setZero(structure_.reduced_size, structure_.reduced_size);
  right_.setZero(structure_.reduced_size);
  AddPoses();
  EliminatePoints();
  AddLineCouplings();
  EliminateLines();
  AddExtraBlocks();
  AddCustomCouplings();
}

bool SchurComplement::Solve(Eigen::VectorXd* solution) {
  return SolveInPlace(right_, &matrix_, solution);
}

bool SchurComplement::Invert(Eigen::MatrixXd* inverse) {
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(right_.size(), right_.size());
  return SolveInPlace(identity, &matrix_, inverse);
}

void SchurComplement::AddPoses() {
  for (int i = 0; i < structure_.num_poses; ++i) {
    const Matrix6d& h = equations_.pose_hessian[i];
    matrix_.block<6, 6>(6 * i, 6 * i) = h;
    matrix_.diagonal().segment<6>(6 * i) += Damping<6>(h, radius_);
    right_.segment<6>(6 * i) = -equations_.pose_gradient[i];
  }
}

// Subtracts W H^-1 W^T from the lower triangle of the matrix, and W H^-1 (-gradient) from the right
// side.
template <int N>
void SchurComplement::Eliminate(const EliminatedBlock<N>& block) {
  const Eigen::Matrix<double, N, 1> x = block.inverse * block.gradient;
  for (int a = 0; a < block.num_poses; ++a) {
    const int row = 6 * block.poses[a];
    const Eigen::Matrix<double, 6, N> y = block.pose_couplings[a] * block.inverse;
    right_.segment<6>(row).noalias() += block.pose_couplings[a] * x;
    for (int b = 0; b < block.num_poses; ++b) {
      if (block.poses[b] > block.poses[a]) continue;
      matrix_.block<6, 6>(row, 6 * block.poses[b]).noalias() -=
          y.lazyProduct(block.pose_couplings[b].transpose());
    }
  }
  for (const DirectionCoupling<N>& a : block.direction_couplings) {
    const Eigen::Matrix<double, 2, N> y = a.block * block.inverse;
    right_.segment<2>(a.row).noalias() += a.block * x;
    for (int b = 0; b < block.num_poses; ++b) {
      matrix_.block<2, 6>(a.row, 6 * block.poses[b]).noalias() -=
          y.lazyProduct(block.pose_couplings[b].transpose());
    }
    for (const DirectionCoupling<N>& b : block.direction_couplings) {
      if (b.row > a.row) continue;
      matrix_.block<2, 2>(a.row, b.row).noalias() -= y.lazyProduct(b.block.transpose());
    }
  }
}

void SchurComplement::EliminatePoints() {
  points_.resize(structure_.num_points);
  for (int i = 0; i < structure_.num_points; ++i) {
    Eigen::Matrix3d h = equations_.points.hessian[i];
    h.diagonal() += Damping<3>(h, radius_);
    SetPoses(structure_.point_blocks, equations_.points, i, &points_[i]);
    if (structure_.point_row[i] >= 0) {
      KeepPoint(points_[i], h, structure_.point_row[i]);
      continue;
    }
    points_[i].inverse = h.llt().solve(Eigen::Matrix3d::Identity());
    Eliminate(points_[i]);
  }
}

void SchurComplement::KeepPoint(const EliminatedBlock<3>& point, const Eigen::Matrix3d& hessian,
                                int row) {
  matrix_.block<3, 3>(row, row) += hessian;
  right_.segment<3>(row) -= point.gradient;
  for (int k = 0; k < point.num_poses; ++k) {
    matrix_.block<3, 6>(row, structure_.PoseRow(point.poses[k])) +=
        point.pose_couplings[k].transpose();
  }
}

void SchurComplement::AddExtraBlocks() {
  for (size_t i = 0; i < structure_.extra_size.size(); ++i) {
    const Eigen::MatrixXd& h = equations_.extra_hessian[i];
    const int row = structure_.extra_row[i];
    matrix_.block(row, row, h.rows(), h.cols()) += h;
    matrix_.diagonal().segment(row, h.rows()) += Damping(h, radius_);
    right_.segment(row, h.rows()) -= equations_.extra_gradient[i];
  }
}

void SchurComplement::AddCustomCouplings() {
  for (const WindowEquations::CustomCoupling& coupling : equations_.custom_couplings) {
    const auto rows =
        CoordinatesOf(structure_, reduced_lines_, coupling.row, coupling.block.rows());
    const auto cols =
        CoordinatesOf(structure_, reduced_lines_, coupling.col, coupling.block.cols());
    for (const ReducedCoordinates& a : rows) {
      for (const ReducedCoordinates& b : cols) {
        const Eigen::MatrixXd h = a.columns.transpose() * coupling.block * b.columns;
        if (a.row > b.row) {
          matrix_.block(a.row, b.row, h.rows(), h.cols()) += h;
        } else {
          matrix_.block(b.row, a.row, h.cols(), h.rows()) += h.transpose();
        }
      }
    }
  }
}

// Adds the line-line blocks: between two directions of the reduced system to the matrix, between a
// direction and an eliminated line to the couplings of that line.
void SchurComplement::AddLineCouplings() {
  reduced_lines_.resize(structure_.num_reduced_lines);
  for (int i = 0; i < structure_.num_lines; ++i) {
    const int number = structure_.reduced_line[i];
    if (number < 0) continue;
    reduced_lines_[number].basis = LineBasis(equations_.directions[i]);
    reduced_lines_[number].row = structure_.DirectionRow(number);
    reduced_lines_[number].position_row = structure_.position_row[number];
  }
  lines_.resize(structure_.num_lines);
  for (size_t k = 0; k < structure_.line_pairs.size(); ++k) {
    auto [a, b] = structure_.line_pairs[k];
    Eigen::Matrix3d h = equations_.line_couplings[k];
    if (structure_.reduced_line[a] < structure_.reduced_line[b]) {
      std::swap(a, b);
      h.transposeInPlace();
    }
    const ReducedLine& reduced_a = reduced_lines_[structure_.reduced_line[a]];
    const Eigen::Matrix<double, 2, 3> h_a = reduced_a.DirectionBasis().transpose() * h;
    if (structure_.reduced_line[b] >= 0) {
      const ReducedLine& reduced_b = reduced_lines_[structure_.reduced_line[b]];
      matrix_.block<2, 2>(reduced_a.row, reduced_b.row) += h_a * reduced_b.DirectionBasis();
    } else {
      Eigen::Matrix<double, 2, 6> coupling;
      coupling << -h_a, h_a;
      lines_[b].direction_couplings.push_back({reduced_a.row, coupling});
    }
  }
}

void SchurComplement::EliminateLines() {
  for (int i = 0; i < structure_.num_lines; ++i) {
    Matrix6d h = equations_.lines.hessian[i];
    h.diagonal() += Damping<6>(h, radius_);
    SetPoses(structure_.line_blocks, equations_.lines, i, &lines_[i]);
    if (structure_.reduced_line[i] >= 0) {
      ReduceLine(lines_[i], h, &reduced_lines_[structure_.reduced_line[i]]);
    } else {
      lines_[i].inverse = h.llt().solve(Matrix6d::Identity());
      Eliminate(lines_[i]);
    }
  }
}

void SchurComplement::ReduceLine(const EliminatedBlock<6>& line, const Matrix6d& hessian,
                                 ReducedLine* reduced) {
  const Matrix6d h = reduced->basis.transpose() * hessian * reduced->basis;
  const Vector6d g = reduced->basis.transpose() * line.gradient;
  const int row = reduced->row;
  matrix_.block<2, 2>(row, row) += h.bottomRightCorner<2, 2>();
  right_.segment<2>(row) -= g.tail<2>();
  reduced->pose_couplings.resize(line.num_poses);
  for (int k = 0; k < line.num_poses; ++k) {
    const Matrix6d w = line.pose_couplings[k] * reduced->basis;
    reduced->pose_couplings[k] = w.leftCols<4>();
    matrix_.block<2, 6>(row, 6 * line.poses[k]) += w.rightCols<2>().transpose();
  }
  if (reduced->position_row >= 0) {
    KeepPosition(h, g, line, *reduced);
    return;
  }
  reduced->position = {h.topLeftCorner<4, 4>().llt().solve(Eigen::Matrix4d::Identity()),
                       g.head<4>(),
                       reduced->pose_couplings.data(),
                       line.poses,
                       line.num_poses,
                       {{row, h.bottomLeftCorner<2, 4>()}}};
  Eliminate(reduced->position);
}

void SchurComplement::KeepPosition(const Matrix6d& hessian, const Vector6d& gradient,
                                   const EliminatedBlock<6>& line, const ReducedLine& reduced) {
  const int row = reduced.position_row;
  matrix_.block<4, 4>(row, row) += hessian.topLeftCorner<4, 4>();
  matrix_.block<4, 2>(row, reduced.row) += hessian.topRightCorner<4, 2>();
  right_.segment<4>(row) -= gradient.head<4>();
  for (int k = 0; k < line.num_poses; ++k) {
    matrix_.block<4, 6>(row, structure_.PoseRow(line.poses[k])) +=
        reduced.pose_couplings[k].transpose();
  }
}

}  // namespace msc_vo
