// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "tests/support/eigen_matchers.h"

namespace msc_vo {

void NearMatcher::DescribeTo(std::ostream* description) const {
  *description << "differs by at most " << tolerance_ << " from\n" << expected_;
}

void NearMatcher::DescribeNegationTo(std::ostream* description) const {
  *description << "differs by more than " << tolerance_ << " from\n" << expected_;
}

bool NearMatcher::Matches(const Eigen::MatrixXd& value, std::ostream* explanation) const {
  const bool same_size = value.rows() == expected_.rows() && value.cols() == expected_.cols();
  // False for NaN.
  const bool near = same_size && ((value - expected_).cwiseAbs().array() <= tolerance_).all();
  if (explanation == nullptr || near) return near;
  if (!same_size) {
    *explanation << "whose size is " << value.rows() << " x " << value.cols();
  } else if (value.size() > 0) {
    *explanation << "whose largest difference is " << (value - expected_).cwiseAbs().maxCoeff();
  }
  return near;
}

}  // namespace msc_vo
