// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <array>

#include <Eigen/Core>

namespace msc_vo {

/// Sums the normal equations of a pose over residual rows, many at a time: J^T W J and J^T W r with
/// the rows of J in the tangent space of Rigid3Manifold, (R X x g, g) (CameraPoints).
class RowSum {
 public:
  /// Adds a row. `rotated`: R X, metres; `by_x`: g, the derivative of the row by camera
  /// coordinates; `weight` of its square.
  void Add(const Eigen::Vector3d& rotated, const Eigen::RowVector3d& by_x, double residual,
           double weight) {
    for (int i = 0; i < 3; ++i) {
      rows_.rotated[i][num_rows_] = rotated[i];
      rows_.by_x[i][num_rows_] = by_x[i];
    }
    rows_.residual[num_rows_] = residual;
    rows_.weight[num_rows_] = weight;
    if (++num_rows_ == kMaxRows) SumUp();
  }

  /// Adds the sums, of the Hessian the lower triangle, and begins anew.
  void AddTo(Eigen::Matrix<double, 6, 6>* hessian, Eigen::Matrix<double, 6, 1>* gradient);

  static constexpr int kMaxRows = 64;
  using Column = std::array<double, kMaxRows>;
  struct Rows {
    std::array<Column, 3> rotated, by_x;
    Column residual, weight;
  };
  /// The lower triangle of the Hessian, column after column, each followed by its entry of the
  /// gradient.
  using Sums = std::array<double, 27>;

 private:
  void SumUp();

  Rows rows_;
  int num_rows_ = 0;
  Sums sums_{};
};

}  // namespace msc_vo
