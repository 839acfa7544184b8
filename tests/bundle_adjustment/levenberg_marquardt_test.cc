// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/bundle_adjustment/levenberg_marquardt.h"

#include <cmath>
#include <vector>

#include <gmock/gmock.h>

namespace msc_vo {
namespace {

using Termination = LevenbergMarquardtTermination;

// One unknown x with the residual atan(x), on which undamped Gauss-Newton diverges from |x| > 1.4.
class ArcTangent {
 public:
  explicit ArcTangent(double x) : x_(x) {}

  bool Linearize() {
    Evaluate(x_, &cost_);
    return is_defined_;
  }
  bool SolveStep(double lambda, double* squared_step) {
    lambdas_.push_back(lambda);
    const double j = 1.0 / (1.0 + x_ * x_);
    step_ = -std::atan(x_) / (j * (1.0 + lambda));
    *squared_step = step_ * step_ * j * j;
    return std::isfinite(step_) && !step_fails_;
  }
  bool TakeStep(bool is_last) {
    last_flags_.push_back(is_last);
    double cost;
    Evaluate(x_ + step_, &cost);
    if (!(cost <= cost_)) return false;
    x_ += step_;
    cost_ = cost;
    return true;
  }

  static void Evaluate(double x, double* cost) { *cost = 0.5 * std::atan(x) * std::atan(x); }

  double x_, cost_ = 0.0, step_ = 0.0;
  bool is_defined_ = true, step_fails_ = false;
  std::vector<double> lambdas_;
  std::vector<bool> last_flags_;
};

TEST(LevenbergMarquardt, ConvergesWhereGaussNewtonDiverges) {
  ArcTangent problem(10.0);
  const LevenbergMarquardtSummary summary = MinimizeByLevenbergMarquardt(50, 1e-12, &problem);
  EXPECT_EQ(summary.termination, Termination::kConverged);
  EXPECT_NEAR(problem.x_, 0.0, 1e-6);
  EXPECT_EQ(static_cast<size_t>(summary.num_iterations), problem.lambdas_.size());
}

TEST(LevenbergMarquardt, DividesDampingAfterAcceptedSteps) {
  ArcTangent problem(0.5);
  MinimizeByLevenbergMarquardt(3, 0.0, &problem);
  ASSERT_EQ(problem.lambdas_.size(), 3u);
  EXPECT_DOUBLE_EQ(problem.lambdas_[0], 1e-4);
  EXPECT_DOUBLE_EQ(problem.lambdas_[1], 1e-5);
  EXPECT_DOUBLE_EQ(problem.lambdas_[2], 1e-6);
}

TEST(LevenbergMarquardt, MultipliesDampingAfterRejectedSteps) {
  ArcTangent problem(10.0);
  MinimizeByLevenbergMarquardt(3, 0.0, &problem);
  EXPECT_EQ(problem.x_, 10.0);
  ASSERT_EQ(problem.lambdas_.size(), 3u);
  EXPECT_DOUBLE_EQ(problem.lambdas_[1], 1e-2);
  EXPECT_DOUBLE_EQ(problem.lambdas_[2], 1.0);
}

TEST(LevenbergMarquardt, MarksTheLastStep) {
  ArcTangent problem(0.5);
  const LevenbergMarquardtSummary summary = MinimizeByLevenbergMarquardt(50, 1e-4, &problem);
  EXPECT_EQ(summary.termination, Termination::kConverged);
  ASSERT_GE(problem.last_flags_.size(), 2u);
  for (size_t i = 0; i + 1 < problem.last_flags_.size(); ++i) EXPECT_FALSE(problem.last_flags_[i]);
  EXPECT_TRUE(problem.last_flags_.back());
}

TEST(LevenbergMarquardt, ReportsTheIterationLimit) {
  ArcTangent problem(0.5);
  const LevenbergMarquardtSummary summary = MinimizeByLevenbergMarquardt(2, 0.0, &problem);
  EXPECT_EQ(summary.termination, Termination::kIterationLimit);
  EXPECT_EQ(summary.num_iterations, 2);
}

TEST(LevenbergMarquardt, FailsWhereTheProblemIsUndefined) {
  ArcTangent undefined(0.5);
  undefined.is_defined_ = false;
  EXPECT_EQ(MinimizeByLevenbergMarquardt(5, 0.0, &undefined).termination, Termination::kFailed);
  EXPECT_TRUE(undefined.lambdas_.empty());

  ArcTangent singular(0.5);
  singular.step_fails_ = true;
  const LevenbergMarquardtSummary summary = MinimizeByLevenbergMarquardt(5, 0.0, &singular);
  EXPECT_EQ(summary.termination, Termination::kFailed);
  EXPECT_EQ(summary.num_iterations, 0);
  EXPECT_EQ(singular.x_, 0.5);
}

}  // namespace
}  // namespace msc_vo
