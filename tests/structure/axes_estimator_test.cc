// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/structure/axes_estimator.h"

#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

#include "msc_vo/geometry/so3.h"

namespace msc_vo {
namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

Quaterniond Turned(double degrees) { return ExpSO3(DegreesToRadians(degrees) * Vector3d::UnitZ()); }

Matrix3d Covariance(double sigma_degrees) {
  const double sigma = DegreesToRadians(sigma_degrees);
  return Vector3d(0.01, 1.0, 0.25).asDiagonal() * Matrix3d::Identity() * (sigma * sigma);
}

class AxesEstimatorTest : public ::testing::Test {
 protected:
  void Grow(int num_keyframes, int num_axis_lines) {
    estimator_.Update({num_keyframes, 2 * num_axis_lines, num_axis_lines});
  }
  // Completes the first refinement, from 40 lines.
  void ReachRefined(double sigma_degrees) {
    estimator_.Propose(Turned(1.0));
    Grow(10, 40);
    ASSERT_TRUE(estimator_.Refine(Turned(0.5), Covariance(sigma_degrees)));
  }
  AxesEstimator estimator_;
};

TEST_F(AxesEstimatorTest, StartsWithoutAxes) {
  EXPECT_EQ(estimator_.state(), AxesState::kNone);
  Grow(100, 1000);
  EXPECT_FALSE(estimator_.RefinementDue());
}

TEST_F(AxesEstimatorTest, AcceptsTheFirstProposalOnly) {
  estimator_.Propose(Turned(1.0));
  EXPECT_EQ(estimator_.state(), AxesState::kCoarse);
  EXPECT_EQ(estimator_.sigma(), AxesEstimator::kCoarseSigma);
  estimator_.Propose(Turned(30.0));
  EXPECT_LT(estimator_.world_from_axes().angularDistance(Turned(1.0)), 1e-12);
}

TEST_F(AxesEstimatorTest, WaitsForKeyframesAndLinesBeforeRefinement) {
  estimator_.Propose(Turned(1.0));
  EXPECT_FALSE(estimator_.RefinementDue());
  Grow(1, 100);
  EXPECT_FALSE(estimator_.RefinementDue());
  Grow(2, 5);
  EXPECT_FALSE(estimator_.RefinementDue());
  Grow(2, 6);
  EXPECT_TRUE(estimator_.RefinementDue());
}

TEST_F(AxesEstimatorTest, ReplacesCoarseAxesByRefinedOnes) {
  ReachRefined(0.2);
  EXPECT_EQ(estimator_.state(), AxesState::kRefined);
  EXPECT_EQ(estimator_.num_refinements(), 1);
  EXPECT_LT(estimator_.world_from_axes().angularDistance(Turned(0.5)), 1e-12);
  // Standard deviation of the least certain direction.
  EXPECT_NEAR(RadiansToDegrees(estimator_.sigma()), 0.2, 1e-12);
}

TEST_F(AxesEstimatorTest, RefinesAgainWhenTheMapHasGrown) {
  ReachRefined(0.2);
  EXPECT_FALSE(estimator_.RefinementDue());
  Grow(30, 43);
  EXPECT_FALSE(estimator_.RefinementDue());
  Grow(30, 44);
  EXPECT_TRUE(estimator_.RefinementDue());
}

TEST_F(AxesEstimatorTest, DropsCoarseAxesWithoutSupportInTheMap) {
  estimator_.Propose(Turned(1.0));
  estimator_.Update({1, 100, 10});
  EXPECT_EQ(estimator_.state(), AxesState::kCoarse) << "too few keyframes";
  estimator_.Update({5, 100, 25});
  EXPECT_EQ(estimator_.state(), AxesState::kCoarse);
  estimator_.Update({6, 100, 24});
  EXPECT_EQ(estimator_.state(), AxesState::kNone);
  estimator_.Propose(Turned(30.0));
  EXPECT_EQ(estimator_.state(), AxesState::kCoarse);
}

TEST_F(AxesEstimatorTest, KeepsRefinedAxesWithoutSupport) {
  ReachRefined(0.2);
  estimator_.Update({20, 1000, 50});
  EXPECT_EQ(estimator_.state(), AxesState::kRefined);
}

TEST_F(AxesEstimatorTest, DropsCoarseAxesOnAContradictingRefinement) {
  estimator_.Propose(Turned(0.0));
  Grow(10, 40);
  EXPECT_FALSE(estimator_.Refine(Turned(5.0), Covariance(0.1)));
  EXPECT_EQ(estimator_.state(), AxesState::kNone);
  EXPECT_EQ(estimator_.num_refinements(), 0);
}

TEST_F(AxesEstimatorTest, IgnoresAContradictingRefinementUntilTheMapHasGrown) {
  ReachRefined(0.2);
  Grow(20, 60);
  EXPECT_FALSE(estimator_.Refine(Turned(10.0), Covariance(0.1)));
  EXPECT_EQ(estimator_.state(), AxesState::kRefined);
  EXPECT_LT(estimator_.world_from_axes().angularDistance(Turned(0.5)), 1e-12);
  EXPECT_FALSE(estimator_.RefinementDue());
  Grow(30, 90);
  EXPECT_TRUE(estimator_.RefinementDue());
}

TEST_F(AxesEstimatorTest, DropsCoarseAxesOnARejectedRefinement) {
  estimator_.Propose(Turned(0.0));
  Grow(10, 40);
  estimator_.RejectRefinement();
  EXPECT_EQ(estimator_.state(), AxesState::kNone);
}

TEST_F(AxesEstimatorTest, DropsCoarseAxesOnANonFiniteRefinement) {
  estimator_.Propose(Turned(0.0));
  Grow(10, 40);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(estimator_.Refine(Turned(0.1), Matrix3d::Constant(nan)));
  EXPECT_EQ(estimator_.state(), AxesState::kNone);
}

TEST_F(AxesEstimatorTest, RejectsInvalidCalls) {
  EXPECT_THROW(estimator_.Refine(Turned(0.0), Covariance(0.1)), std::invalid_argument);
  EXPECT_THROW(estimator_.RejectRefinement(), std::invalid_argument);
}

TEST(AxesState, HasNames) {
  EXPECT_STREQ(ToString(AxesState::kNone), "none");
  EXPECT_STREQ(ToString(AxesState::kCoarse), "coarse");
  EXPECT_STREQ(ToString(AxesState::kRefined), "refined");
}

}  // namespace
}  // namespace msc_vo
