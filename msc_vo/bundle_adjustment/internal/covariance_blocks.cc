// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/bundle_adjustment/internal/covariance_blocks.h"

#include "msc_vo/bundle_adjustment/internal/schur_complement.h"

namespace msc_vo {

namespace {

// H^-1 W^T of an eliminated block, with one column per unknown of the reduced system.
template <int N>
Eigen::Matrix<double, N, Eigen::Dynamic> Influence(const EliminatedBlock<N>& block,
                                                   Eigen::Index reduced_size) {
  Eigen::Matrix<double, N, Eigen::Dynamic> influence =
      Eigen::Matrix<double, N, Eigen::Dynamic>::Zero(N, reduced_size);
  for (int a = 0; a < block.num_poses; ++a) {
    influence.template middleCols<6>(6 * block.poses[a]) +=
        block.inverse * block.pose_couplings[a].transpose();
  }
  for (const DirectionCoupling<N>& a : block.direction_couplings) {
    influence.template middleCols<2>(a.row) += block.inverse * a.block.transpose();
  }
  return influence;
}

// H^-1 + H^-1 W^T S^-1 W H^-1, with S^-1 = `reduced` the inverse of the reduced system's matrix.
template <int N>
Eigen::Matrix<double, N, N> Covariance(const EliminatedBlock<N>& block,
                                       const Eigen::MatrixXd& reduced) {
  const Eigen::Matrix<double, N, Eigen::Dynamic> influence = Influence(block, reduced.rows());
  return block.inverse + influence * reduced * influence.transpose();
}

Eigen::Matrix<double, 6, 6> Covariance(const ReducedLine& line, const Eigen::MatrixXd& reduced) {
  Eigen::Matrix<double, 6, 6> covariance;  // of position, then direction
  if (line.position_row < 0) {
    covariance.topLeftCorner<4, 4>() = Covariance(line.position, reduced);
    covariance.topRightCorner<4, 2>() =
        -Influence(line.position, reduced.rows()) * reduced.middleCols<2>(line.row);
  } else {
    covariance.topLeftCorner<4, 4>() = reduced.block<4, 4>(line.position_row, line.position_row);
    covariance.topRightCorner<4, 2>() = reduced.block<4, 2>(line.position_row, line.row);
  }
  covariance.bottomLeftCorner<2, 4>() = covariance.topRightCorner<4, 2>().transpose();
  covariance.bottomRightCorner<2, 2>() = reduced.block<2, 2>(line.row, line.row);
  return line.basis * covariance * line.basis.transpose();
}

}  // namespace

bool ComputeCovarianceBlocks(const BlockStructure& structure, const WindowEquations& equations,
                             double radius, const UnknownSelection& selected,
                             CovarianceBlocks* covariances) {
  SchurComplement schur(structure, equations, radius);
  Eigen::MatrixXd reduced;
  if (!schur.Invert(&reduced)) return false;
  for (const int i : selected.poses) {
    covariances->poses.push_back(reduced.block<6, 6>(6 * i, 6 * i));
  }
  for (const int i : selected.points) {
    const int row = structure.point_row[i];
    covariances->points.push_back(row < 0 ? Covariance(schur.points()[i], reduced)
                                          : Eigen::Matrix3d(reduced.block<3, 3>(row, row)));
  }
  for (const int i : selected.lines) {
    const int number = structure.reduced_line[i];
    covariances->lines.push_back(number < 0 ? Covariance(schur.lines()[i], reduced)
                                            : Covariance(schur.reduced_lines()[number], reduced));
  }
  for (const int i : selected.extra) {
    const int row = structure.extra_row[i];
    const int size = structure.extra_size[i];
    covariances->extra.push_back(reduced.block(row, row, size, size));
  }
  return true;
}

}  // namespace msc_vo
