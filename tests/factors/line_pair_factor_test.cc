// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Tests that all line pair factors share.

#include "msc_vo/factors/line_pair_factor.h"

#include "tests/support/factor_checks.h"

#include "msc_vo/factors/analytic_line_pair_cost_function.h"
#include "msc_vo/factors/parallel_lines.h"
#include "msc_vo/factors/perpendicular_lines.h"

namespace msc_vo {
namespace {

template <typename Factor>
class LinePairFactorTest : public ::testing::Test {
 protected:
  void ExpectGradients(const LineSegment3& a, const LineSegment3& b) {
    const Blocks blocks{Block(a), Block(b)};
    const CostPtr automatic(Factor::Create(factor_));
    ExpectGradientsMatch(*automatic, blocks);
    ExpectSameCostFunction(AnalyticLinePairCostFunction<Factor>(factor_), *automatic, blocks);
  }
  Factor factor_{0.03};
  RandomGeometry random_{3};
};
using LinePairFactors = ::testing::Types<ParallelLines, PerpendicularLines>;
TYPED_TEST_SUITE(LinePairFactorTest, LinePairFactors, );

TYPED_TEST(LinePairFactorTest, DerivativesMatchAlsoWhereThePapersFormIsSingular) {
  RandomGeometry& random = this->random_;
  for (int i = 0; i < 10; ++i) this->ExpectGradients(random.Line(), random.Line());
  const Eigen::Vector3d d = random.Normal3().normalized();
  const LineSegment3 a = random.LineAlong(d);
  this->ExpectGradients(a, random.LineAlong(d));                   // parallel
  this->ExpectGradients(a, random.LineAlong(-d));                  // opposite
  this->ExpectGradients(a, random.LineAlong(d.unitOrthogonal()));  // perpendicular
  this->ExpectGradients(a, a);                                     // identical
}

TYPED_TEST(LinePairFactorTest, EvaluatesEachJacobianSeparately) {
  const AnalyticLinePairCostFunction<TypeParam> cost(this->factor_);
  const Blocks blocks{Block(this->random_.Line()), Block(this->random_.Line())};
  ExpectEachJacobianSeparately(cost, blocks);
}

TYPED_TEST(LinePairFactorTest, IsUndefinedForZeroLength) {
  const CostPtr automatic(TypeParam::Create(this->factor_));
  const AnalyticLinePairCostFunction<TypeParam> analytic(this->factor_);
  const std::vector<double> point{1.0, 2.0, 3.0, 1.0, 2.0, 3.0}, line{0.0, 0.0, 0.0, 1.0, 0.0, 0.0};
  for (const ceres::CostFunction* cost :
       std::initializer_list<const ceres::CostFunction*>{automatic.get(), &analytic}) {
    EXPECT_FALSE(IsDefined(*cost, {point, line}));
    EXPECT_FALSE(IsDefined(*cost, {line, point}));
    EXPECT_TRUE(IsDefined(*cost, {line, line}));
  }
}

}  // namespace
}  // namespace msc_vo
