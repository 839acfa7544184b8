// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include "msc_vo/bundle_adjustment/internal/window_equations.h"

namespace msc_vo {

/// Numbers of unknowns whose covariances are requested.
struct UnknownSelection {
  std::vector<int> poses, points, lines;
  std::vector<int> extra = {};
};

/// Diagonal blocks of (H + D / radius)^-1, in the order of an UnknownSelection.
struct CovarianceBlocks {
  std::vector<Eigen::Matrix<double, 6, 6>> poses;
  std::vector<Eigen::Matrix3d> points;
  std::vector<Eigen::Matrix<double, 6, 6>> lines;
  std::vector<Eigen::MatrixXd> extra;
};

/// Computes the selected blocks by Schur complement. Returns false if the equations are not
/// positive definite.
bool ComputeCovarianceBlocks(const BlockStructure& structure, const WindowEquations& equations,
                             double radius, const UnknownSelection& selected,
                             CovarianceBlocks* covariances);

}  // namespace msc_vo
