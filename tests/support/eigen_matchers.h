// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <ostream>
#include <utility>

#include <Eigen/Core>
#include <gmock/gmock.h>

namespace msc_vo {

// See IsNear().
class NearMatcher {
 public:
  using is_gtest_matcher = void;

  NearMatcher(Eigen::MatrixXd expected, double tolerance)
      : expected_(std::move(expected)), tolerance_(tolerance) {}

  template <typename Derived>
  bool MatchAndExplain(const Eigen::MatrixBase<Derived>& value, std::ostream* explanation) const {
    return Matches(value, explanation);
  }
  void DescribeTo(std::ostream* description) const;
  void DescribeNegationTo(std::ostream* description) const;

 private:
  // Compiled once for values of all types.
  bool Matches(const Eigen::MatrixXd& value, std::ostream* explanation) const;

  Eigen::MatrixXd expected_;
  double tolerance_;
};

// Matches a vector or matrix of the same size as `expected` whose entries differ by at most
// `tolerance`.
template <typename Derived>
NearMatcher IsNear(const Eigen::MatrixBase<Derived>& expected, double tolerance) {
  return {expected, tolerance};
}

}  // namespace msc_vo
