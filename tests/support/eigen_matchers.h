// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <Eigen/Core>
#include <gmock/gmock.h>

namespace msc_vo {

// Matches a vector or matrix of the same size as `expected` whose entries differ by at most
// `tolerance`.
MATCHER_P2(IsNear, expected, tolerance, "") {
  if (arg.rows() != expected.rows() || arg.cols() != expected.cols()) {
    *result_listener << "sizes differ";
    return false;
  }
  const double error = (arg - expected).cwiseAbs().maxCoeff();
  *result_listener << "\n" << arg << "\nexpected\n" << expected << "\nlargest difference " << error;
  return error <= tolerance;  // false for NaN
}

}  // namespace msc_vo
