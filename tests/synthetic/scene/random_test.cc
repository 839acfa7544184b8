// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/synthetic/scene/random.h"

#include <gtest/gtest.h>

namespace msc_vo {
namespace {

TEST(RandomTest, IsDeterminedBySeedAndStream) {
  Random a(7, 3), b(7, 3), other_stream(7, 4), other_seed(8, 3);
  const uint64_t first = a.Next();
  EXPECT_EQ(first, b.Next());
  EXPECT_NE(first, other_stream.Next());
  EXPECT_NE(first, other_seed.Next());
}

TEST(RandomTest, UniformHasExpectedRangeAndMoments) {
  Random random(1);
  double sum = 0.0, squares = 0.0;
  const int count = 100000;
  for (int i = 0; i < count; ++i) {
    const double x = random.Uniform(2.0, 5.0);
    ASSERT_GE(x, 2.0);
    ASSERT_LT(x, 5.0);
    sum += x;
    squares += (x - 3.5) * (x - 3.5);
  }
  EXPECT_NEAR(sum / count, 3.5, 0.015);             // 5 sigmas of the mean
  EXPECT_NEAR(squares / count, 9.0 / 12.0, 0.015);  // variance of a uniform deviate
}

TEST(RandomTest, NormalHasUnitVarianceAndTails) {
  Random random(2);
  double sum = 0.0, squares = 0.0;
  int beyond = 0;
  const int count = 100000;
  for (int i = 0; i < count; ++i) {
    const double x = random.Normal();
    sum += x;
    squares += x * x;
    beyond += std::abs(x) > 1.960 ? 1 : 0;
  }
  EXPECT_NEAR(sum / count, 0.0, 0.016);
  EXPECT_NEAR(squares / count, 1.0, 0.023);
  EXPECT_NEAR(beyond / static_cast<double>(count), 0.05, 0.0035);
}

TEST(RandomTest, SuccessiveNormalsAreIndependent) {
  Random random(4);
  double product = 0.0, squares_product = 0.0;
  const int count = 100000;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector2d pair = random.Normal2();
    product += pair.x() * pair.y();
    squares_product += (pair.x() * pair.x() - 1.0) * (pair.y() * pair.y() - 1.0);
  }
  EXPECT_NEAR(product / count, 0.0, 0.016);
  EXPECT_NEAR(squares_product / count, 0.0, 0.032);
}

TEST(RandomTest, PoissonHasEqualMeanAndVariance) {
  Random random(5);
  EXPECT_EQ(random.Poisson(0.0), 0);
  for (const double mean : {0.3, 4.0, 29.0, 31.0, 300.0}) {
    double sum = 0.0, squares = 0.0;
    const int count = 100000;
    for (int i = 0; i < count; ++i) {
      const int x = random.Poisson(mean);
      ASSERT_GE(x, 0);
      sum += x;
      squares += (x - mean) * (x - mean);
    }
    EXPECT_NEAR(sum / count / mean, 1.0, 0.03) << mean;
    EXPECT_NEAR(squares / count / mean, 1.0, 0.05) << mean;
  }
}

TEST(RandomTest, IndexIsUniformOverRange) {
  Random random(3);
  int counts[5] = {};
  for (int i = 0; i < 5000; ++i) {
    const int index = random.Index(5);
    ASSERT_GE(index, 0);
    ASSERT_LT(index, 5);
    ++counts[index];
  }
  for (const int count : counts) EXPECT_NEAR(count, 1000, 150);
}

}  // namespace
}  // namespace msc_vo
