// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/factors/robust_loss.h"

#include <ceres/loss_function.h>
#include <gtest/gtest.h>

namespace msc_vo {
namespace {

TEST(HuberLoss, MatchesCeres) {
  for (const double threshold : {0.5, 1.96, 2.448}) {
    const HuberLoss loss{threshold};
    const ceres::HuberLoss expected(threshold);
    for (const double s : {0.0, 1e-6, 0.2, 3.8, 6.1, 40.0, 1e6}) {
      double rho[3];
      expected.Evaluate(s, rho);
      EXPECT_DOUBLE_EQ(loss.Cost(s), rho[0]) << threshold << " " << s;
      EXPECT_DOUBLE_EQ(loss.Weight(s), rho[1]) << threshold << " " << s;
    }
  }
}

TEST(HuberLoss, IsQuadraticWithoutThreshold) {
  const HuberLoss loss;
  EXPECT_EQ(loss.Cost(1e9), 1e9);
  EXPECT_EQ(loss.Weight(1e9), 1.0);
}

TEST(HuberLoss, IsContinuousAtTheThreshold) {
  const HuberLoss loss{2.0};
  EXPECT_EQ(loss.Cost(4.0), 4.0);
  EXPECT_NEAR(loss.Cost(4.0 + 1e-9), 4.0, 2e-9);
  EXPECT_NEAR(loss.Weight(4.0 + 1e-9), 1.0, 1e-9);
}

}  // namespace
}  // namespace msc_vo
