// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/pose_estimation/row_sum.h"

#include "msc_vo/geometry/avx2.h"

namespace msc_vo {

namespace {

constexpr int kMaxRows = RowSum::kMaxRows;
// Partial sums: they fit one vector with AVX2 and two without, and have the same bits with both.
constexpr int kLanes = 4;
static_assert(kMaxRows % kLanes == 0);

// The sum of a[i] b[i]; `size` is a multiple of kLanes.
inline double Dot(const double* a, const double* b, int size) {
  double sums[kLanes] = {};
  for (int i = 0; i < size; i += kLanes) {
    for (int lane = 0; lane < kLanes; ++lane) sums[lane] += a[i + lane] * b[i + lane];
  }
  return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

MSC_VO_AVX2_IF_PRESENT
void AddNormalEquations(const RowSum::Rows& rows, int size, RowSum::Sums* sums) {
  double j[6][kMaxRows], weighted[6][kMaxRows];
  const auto& [x, y, z] = rows.rotated;
  const auto& [u, v, w] = rows.by_x;
  for (int i = 0; i < size; ++i) {
    j[0][i] = y[i] * w[i] - z[i] * v[i];
    j[1][i] = z[i] * u[i] - x[i] * w[i];
    j[2][i] = x[i] * v[i] - y[i] * u[i];
    j[3][i] = u[i];
    j[4][i] = v[i];
    j[5][i] = w[i];
  }
  double* sum = sums->data();
  for (int column = 0; column < 6; ++column) {
    for (int i = 0; i < size; ++i) weighted[column][i] = rows.weight[i] * j[column][i];
    for (int row = column; row < 6; ++row) *sum++ += Dot(weighted[column], j[row], size);
    *sum++ += Dot(weighted[column], rows.residual.data(), size);
  }
}

}  // namespace

void RowSum::AddTo(Eigen::Matrix<double, 6, 6>* hessian, Eigen::Matrix<double, 6, 1>* gradient) {
  if (num_rows_ > 0) SumUp();
  const double* sum = sums_.data();
  for (int column = 0; column < 6; ++column) {
    for (int row = column; row < 6; ++row) (*hessian)(row, column) += *sum++;
    (*gradient)[column] += *sum++;
  }
  sums_.fill(0.0);
}

void RowSum::SumUp() {
  for (; num_rows_ % kLanes != 0; ++num_rows_) {
    for (auto* part : {&rows_.rotated, &rows_.by_x}) {
      for (Column& column : *part) column[num_rows_] = 0.0;
    }
    rows_.residual[num_rows_] = rows_.weight[num_rows_] = 0.0;
  }
  AddNormalEquations(rows_, num_rows_, &sums_);
  num_rows_ = 0;
}

}  // namespace msc_vo
