// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/evaluation/error_statistics.h"

#include <cmath>

#include <gtest/gtest.h>

namespace msc_vo {
namespace {

TEST(StatisticsOf, MatchesHandComputedValues) {
  const ErrorStatistics odd = StatisticsOf({4.0, 1.0, 1.0});
  EXPECT_EQ(odd.count, 3);
  EXPECT_DOUBLE_EQ(odd.rmse, std::sqrt(6.0));
  EXPECT_DOUBLE_EQ(odd.mean, 2.0);
  EXPECT_EQ(odd.median, 1.0);
  EXPECT_EQ(odd.p95, 4.0);
  EXPECT_EQ(odd.max, 4.0);
  EXPECT_EQ(StatisticsOf({3.0, 1.0, 2.0, 7.0}).median, 2.5);
  EXPECT_EQ(StatisticsOf({}).count, 0);
  EXPECT_EQ(StatisticsOf({}).max, 0.0);
}

TEST(StatisticsOf, P95IsNineteenthOfTwentySamples) {
  std::vector<double> values;
  for (int i = 1; i <= 20; ++i) values.push_back(i);
  EXPECT_EQ(StatisticsOf(values).p95, 19.0);
  values.push_back(21.0);
  EXPECT_EQ(StatisticsOf(values).p95, 20.0);
}

}  // namespace
}  // namespace msc_vo
