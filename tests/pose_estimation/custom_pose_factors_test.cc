// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "tests/support/custom_pose_factors.h"

#include <limits>
#include <stdexcept>
#include <utility>

#include "tests/pose_estimation/window_frame.h"
#include "tests/support/factor_checks.h"
#include "tests/support/message_matchers.h"
#include <gmock/gmock.h>

#include "msc_vo/pose_estimation/pose_factors.h"
#include "msc_vo/pose_estimation/pose_optimization.h"

namespace msc_vo {
namespace {

// The factors as a Ceres problem over `pose`.
void AddToCeres(const std::vector<PoseFactor>& factors, Rigid3* pose, ceres::Problem* problem) {
  problem->AddParameterBlock(pose->params.data(), 7, new Rigid3Manifold);
  for (const PoseFactor& factor : factors) {
    problem->AddResidualBlock(const_cast<ceres::CostFunction*>(factor.cost.get()),
                              const_cast<ceres::LossFunction*>(factor.loss.get()),
                              pose->params.data());
  }
}

ceres::Problem::Options WithoutOwnership() {
  ceres::Problem::Options options;
  options.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  return options;
}

// A pose, gravity with a Huber loss, and a pose with a Cauchy loss that contradicts both.
std::vector<PoseFactor> ContradictingFactors(const Rigid3& pose) {
  std::vector<PoseFactor> factors = {
      PriorFactor("a", pose, 0.02, 0.05),
      GravityFactor(Eigen::Vector3d(0.1, 0.9, -0.2).normalized(), 0.01),
      PriorFactor("b", Moved(pose, {0.1, 0.2, -0.1}, {0.3, 0.1, 0.2}), 0.03, 0.02)};
  factors[1].loss = std::make_shared<ceres::HuberLoss>(2.0);
  factors[2].loss = std::make_shared<ceres::CauchyLoss>(3.0);
  return factors;
}

// Contradicting factors around a random pose, and a pose in their neighbourhood.
std::pair<PoseFactors, Rigid3> RandomFactors(RandomGeometry* random) {
  const Rigid3 mean = random->Pose();
  PoseFactors factors;
  factors.custom = ContradictingFactors(mean);
  const Eigen::Vector3d w = 0.1 * random->Normal3(), u = 0.3 * random->Normal3();
  return {factors, Moved(mean, w, u)};
}

TEST(CustomPoseFactors, EquationsMatchCeres) {
  RandomGeometry random(1);
  for (int i = 0; i < 10; ++i) {
    const auto [factors, start] = RandomFactors(&random);
    Rigid3 pose = start;
    EXPECT_EQ(factors.NumRows(), 15);
    NormalEquations ours;
    ASSERT_TRUE(factors.Linearize(pose, &ours));
    double cost_alone = 0.0;
    ASSERT_TRUE(factors.Cost(pose, &cost_alone));
    EXPECT_EQ(cost_alone, ours.cost);

    ceres::Problem problem(WithoutOwnership());
    AddToCeres(factors.custom, &pose, &problem);
    double cost = 0.0;
    std::vector<double> gradient;
    ASSERT_TRUE(problem.Evaluate({}, &cost, nullptr, &gradient, nullptr));
    EXPECT_NEAR(ours.cost, cost, 1e-10 * cost);
    const Eigen::Map<Eigen::Matrix<double, 6, 1>> expected(gradient.data());
    EXPECT_THAT(ours.gradient, IsNear(expected, 1e-10 * expected.norm()));
  }
}

TEST(CustomPoseFactors, GradientMatchesTheDifferencesOfTheCost) {
  RandomGeometry random(2);
  for (int i = 0; i < 10; ++i) {
    const auto [factors, pose] = RandomFactors(&random);
    NormalEquations equations;
    ASSERT_TRUE(factors.Linearize(pose, &equations));
    constexpr double kStep = 1e-5;
    for (int k = 0; k < 6; ++k) {
      const Eigen::Matrix<double, 6, 1> d = kStep * Eigen::Matrix<double, 6, 1>::Unit(k);
      double after = 0.0, before = 0.0;
      factors.Cost(Moved(pose, d.head<3>(), d.tail<3>()), &after);
      factors.Cost(Moved(pose, -d.head<3>(), -d.tail<3>()), &before);
      EXPECT_NEAR(equations.gradient[k], (after - before) / (2.0 * kStep),
                  1e-6 * equations.gradient.norm());
    }
  }
}

TEST(CustomPoseFactors, MinimumMatchesCeres) {
  RandomGeometry random(3);
  const Rigid3 mean = random.Pose();
  PoseFactors factors;
  factors.custom = ContradictingFactors(mean);
  Rigid3 pose = Moved(mean, {0.05, -0.1, 0.02}, {0.2, -0.1, 0.3});
  Rigid3 of_ceres = pose;
  EXPECT_EQ(MinimizePose(factors, 100, &pose), LevenbergMarquardtTermination::kConverged);
  ceres::Problem problem(WithoutOwnership());
  AddToCeres(factors.custom, &of_ceres, &problem);
  SolveToEnd(&problem);
  // Sigmas are centimetres; the minimiser stops at steps of 3 % of a sigma, and then converges
  // linearly, because the contradicting factors leave large residuals.
  EXPECT_LT(Distance(pose, of_ceres), 2e-4);
}

TEST(CustomPoseFactors, GravityTurnsThePose) {
  const TestWindow window = MakeTestWindow(TestWindowOptions());
  const Eigen::Vector3d in_cam =
      ExpSO3({0.002, 0.0, -0.001}) * (Truth(window).rotation() * Eigen::Vector3d(0.0, 1.0, 0.0));
  const auto error = [&](double sigma) {
    PoseData data = MakePoseData(window, kFrame);
    if (sigma > 0.0) data.custom_factors = {GravityFactor(in_cam, sigma)};
    EXPECT_TRUE(OptimizePose(PoseOptions(), &data).usable);
    const Eigen::Vector3d estimate = data.cam_from_world.rotation() * Eigen::Vector3d::UnitY();
    return estimate.cross(in_cam).norm();
  };
  // 0.0022 radians between gravity and the matches, whose rotation has a sigma of about 0.0003.
  EXPECT_GT(error(0.0), 1e-3);
  EXPECT_LT(error(1e-5), 2e-5);
  EXPECT_NEAR(error(1.0), error(0.0), 1e-5);
}

TEST(CustomPoseFactors, DetermineThePoseWithoutMatches) {
  const TestWindow window = MakeTestWindow(TestWindowOptions());
  PoseData data = MakePoseData(window, kFrame);
  data.points.clear();
  data.lines.clear();
  const Rigid3 prediction = data.cam_from_world;
  const Rigid3 mean = Moved(prediction, {0.3, 0.1, -0.2}, {1.0, -0.5, 0.2});
  data.custom_factors = {GravityFactor(Eigen::Vector3d::UnitY(), 0.01)};
  EXPECT_FALSE(OptimizePose(PoseOptions(), &data).usable);  // the heading is free
  EXPECT_EQ(data.cam_from_world.params, prediction.params);

  data.custom_factors = {PriorFactor("step", mean, 0.02, 0.03)};
  const PoseSummary summary = OptimizePose(PoseOptions(), &data);
  EXPECT_TRUE(summary.usable);
  EXPECT_EQ(summary.num_inliers.points + summary.num_inliers.lines, 0);
  EXPECT_LT(Distance(data.cam_from_world, mean), 1e-6);
  const Eigen::Matrix<double, 6, 6> expected = DiagonalPoseCovariance(0.02, 0.03);
  EXPECT_THAT(summary.covariance, IsNear(expected, 1e-9));
}

TEST(CustomPoseFactors, KeepTheirLossInEveryRound) {
  const TestWindow window = MakeTestWindow(TestWindowOptions());
  // Slipping wheels: ten centimetres off, and sure of a millimetre.
  PoseFactor wheel =
      PriorFactor("wheel", Moved(Truth(window), {0.0, 0.0, 0.0}, {0.1, 0.0, 0.0}), 0.001, 0.001);
  const auto estimate = [&](const std::vector<PoseFactor>& factors) {
    PoseData data = MakePoseData(window, kFrame);
    data.custom_factors = factors;
    OptimizePose(PoseOptions(), &data);
    return data.cam_from_world;
  };
  EXPECT_GT(Distance(estimate({wheel}), estimate({})), 0.03);
  wheel.loss = std::make_shared<ceres::CauchyLoss>(1.0);
  EXPECT_LT(Distance(estimate({wheel}), estimate({})), 5e-4);
}

// Fails, or returns a number that is not finite, beyond x = `limit` metres.
class LimitedCost : public ceres::SizedCostFunction<1, 7> {
 public:
  LimitedCost(double limit, bool fails) : limit_(limit), fails_(fails) {}
  bool Evaluate(const double* const* x, double* r, double** jacobians) const override {
    const bool is_beyond = x[0][4] > limit_;
    r[0] = is_beyond ? std::numeric_limits<double>::quiet_NaN() : x[0][4];
    if (jacobians != nullptr && jacobians[0] != nullptr) {
      std::fill(jacobians[0], jacobians[0] + 7, 0.0);
      jacobians[0][4] = 1.0;
    }
    return !(is_beyond && fails_);
  }

 private:
  double limit_;
  bool fails_;
};

class TwoBlocks : public ceres::SizedCostFunction<1, 7, 7> {
  bool Evaluate(const double* const*, double*, double**) const override { return true; }
};
class LandmarkFactor : public ceres::SizedCostFunction<1, 3> {
  bool Evaluate(const double* const*, double*, double**) const override { return true; }
};
class NoRows : public ceres::CostFunction {
 public:
  NoRows() { mutable_parameter_block_sizes()->push_back(7); }
  bool Evaluate(const double* const*, double*, double**) const override { return true; }
};

TEST(CustomPoseFactors, NameTheInvalidFactor) {
  const PoseData good = MakePoseData(MakeTestWindow(TestWindowOptions()), kFrame);
  const auto message = [&](std::shared_ptr<const ceres::CostFunction> cost) {
    PoseData data = good;
    data.custom_factors = {PriorFactor("good", data.cam_from_world, 1.0, 1.0),
                           {"wheel", std::move(cost), nullptr}};
    try {
      OptimizePose(PoseOptions(), &data);
    } catch (const std::invalid_argument& error) {
      EXPECT_EQ(data.cam_from_world.params, good.cam_from_world.params);
      return std::string(error.what());
    }
    return std::string("nothing was thrown");
  };
  const double below = good.cam_from_world.translation().x() - 1.0;
  EXPECT_THAT(message(nullptr), Names("'wheel'", "null"));
  EXPECT_THAT(message(std::make_shared<TwoBlocks>()), Names("'wheel'", "parameter block", "2"));
  EXPECT_THAT(message(std::make_shared<LandmarkFactor>()), Names("'wheel'", "3", "block 0", "7"));
  EXPECT_THAT(message(std::make_shared<NoRows>()), Names("'wheel'", "residual"));
  for (const bool fails : {false, true}) {
    EXPECT_THAT(message(std::make_shared<LimitedCost>(below, fails)),
                Names("'wheel'", "evaluated"));
  }
  EXPECT_EQ(message(std::make_shared<LimitedCost>(1e9, true)), "nothing was thrown");
}

// The minimum, at x = 0, is separated from the start by the limit: steps beyond are refused.
TEST(CustomPoseFactors, RefuseStepsToWhereTheyAreUndefined) {
  PoseFactors factors;
  factors.custom = {
      PriorFactor("far", Rigid3(Eigen::Quaterniond::Identity(), {2.0, 0.0, 0.0}), 1.0, 1.0),
      {"limit", std::make_shared<LimitedCost>(0.5, true), nullptr}};
  Rigid3 pose;
  EXPECT_NE(MinimizePose(factors, 20, &pose), LevenbergMarquardtTermination::kFailed);
  EXPECT_LE(pose.translation().x(), 0.5);
  EXPECT_GT(pose.translation().x(), 0.1);
}

}  // namespace
}  // namespace msc_vo
