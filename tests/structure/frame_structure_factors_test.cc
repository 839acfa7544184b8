// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/structure/frame_structure_factors.h"

#include "tests/support/structure_frame.h"
#include <Eigen/LU>
#include <ceres/loss_function.h>

#include "msc_vo/factors/inverse_depth_line_pair.h"

namespace msc_vo {
namespace {

// Twelve lines of a room with noisy depths, and all pairs that are parallel or perpendicular.
class FrameStructureFactorsTest : public ::testing::Test {
 protected:
  FrameStructureFactorsTest() {
    StructureFrameOptions scene;
    scene.num_lines = 12;
    scene.free_ratio = 0.0;
    frame_ = MakeStructureFrame(scene);
    factors_.huber = 2.0;
    for (const StructureLine& line : frame_.lines) {
      factors_.lines.emplace_back(frame_.camera, line.segment, line.depth, line.sigma, 0.006);
      factors_.priors.emplace_back(line.depth);
      blocks_.emplace_back(line.depth.start, line.depth.end, 0.0, 0.0);
    }
    for (int i = 0; i < 12; ++i) {
      for (int j = i + 1; j < 12; ++j) {
        const double angle =
            UndirectedAngle(frame_.truth[i].Direction(), frame_.truth[j].Direction());
        if (angle < 0.1) factors_.parallel.push_back({ParallelLines(kSigma), i, j});
        if (angle > 1.4) factors_.perpendicular.push_back({PerpendicularLines(kSigma), i, j});
      }
    }
  }

  // Reference: the same factors as a Ceres problem.
  void AddTo(ceres::Problem* problem, std::vector<InverseDepthLineBlock>* blocks) const {
    for (size_t i = 0; i < factors_.lines.size(); ++i) {
      problem->AddResidualBlock(InverseDepthLinePrior::Create(frame_.lines[i].depth), nullptr,
                                (*blocks)[i].data());
    }
    const auto add = [&](ceres::CostFunction* cost, int i, int j) {
      problem->AddResidualBlock(cost, new ceres::HuberLoss(factors_.huber), (*blocks)[i].data(),
                                (*blocks)[j].data());
    };
    for (const auto& p : factors_.parallel) {
      add(InverseDepthLinePair<ParallelLines>::Create(factors_.lines[p.i], factors_.lines[p.j],
                                                      kSigma),
          p.i, p.j);
    }
    for (const auto& p : factors_.perpendicular) {
      add(InverseDepthLinePair<PerpendicularLines>::Create(factors_.lines[p.i], factors_.lines[p.j],
                                                           kSigma),
          p.i, p.j);
    }
  }

  static constexpr double kSigma = 0.008;
  StructureFrame frame_;
  FrameStructureFactors factors_;
  std::vector<InverseDepthLineBlock> blocks_;
};

TEST_F(FrameStructureFactorsTest, CostAndGradientMatchCeres) {
  ASSERT_GT(factors_.parallel.size(), 5u);
  ASSERT_GT(factors_.perpendicular.size(), 5u);
  RandomGeometry random(3);
  for (InverseDepthLineBlock& b : blocks_) {
    b.head<2>() += 0.004 * random.Normal2();
    b.tail<2>() += random.Normal2();
  }
  StructureEquations equations;
  ASSERT_TRUE(factors_.Linearize(blocks_, &equations));
  ceres::Problem problem;
  AddTo(&problem, &blocks_);
  double cost = 0.0;
  std::vector<double> gradient;
  ASSERT_TRUE(problem.Evaluate({}, &cost, nullptr, &gradient, nullptr));
  EXPECT_NEAR(equations.cost, cost, 1e-9 * cost);
  for (size_t i = 0; i < blocks_.size(); ++i) {
    const InverseDepthLineBlock expected(&gradient[4 * i]);
    EXPECT_THAT(equations.gradient[i], IsNear(expected, 1e-9 * (1.0 + expected.norm())));
  }
}

TEST_F(FrameStructureFactorsTest, MinimumMatchesCeres) {
  // A gross outlier activates the robust loss.
  factors_.perpendicular.push_back(
      {PerpendicularLines(kSigma), factors_.parallel[0].i, factors_.parallel[0].j});
  std::vector<InverseDepthLineBlock> expected = blocks_, actual = blocks_;
  ceres::Problem problem;
  AddTo(&problem, &expected);
  SolveToEnd(&problem);
  StructureEquations equations;
  ASSERT_TRUE(MinimizeStructure(factors_, 200, &actual, &equations));
  double cost = 0.0;
  ASSERT_TRUE(problem.Evaluate({}, &cost, nullptr, nullptr, nullptr));
  EXPECT_NEAR(equations.cost, cost, 1e-4);
  for (size_t i = 0; i < actual.size(); ++i) {
    // In sigmas of the fit; the minimiser terminates at a hundredth.
    Eigen::Vector4d error;
    const InverseDepthLineBlock difference = actual[i] - expected[i];
    LineDepth at_zero = frame_.lines[i].depth;
    at_zero.start = at_zero.end = 0.0;
    InverseDepthLinePrior prior(at_zero);
    prior(difference.data(), error.data());
    EXPECT_LT(error.norm(), 0.02) << i;
  }
}

TEST_F(FrameStructureFactorsTest, BoundsCovariancesBetweenTheExactOnesAndThePriors) {
  StructureEquations equations;
  ASSERT_TRUE(factors_.Linearize(blocks_, &equations));
  const auto bounds = BoundCovariances(factors_, equations);
  const int n = static_cast<int>(blocks_.size());
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(4 * n, 4 * n);
  for (int i = 0; i < n; ++i) information.block<4, 4>(4 * i, 4 * i) = equations.diagonal[i];
  for (const auto& p : equations.pairs) {
    information.block<4, 4>(4 * p.i, 4 * p.j) += p.ij;
    information.block<4, 4>(4 * p.j, 4 * p.i) += p.ij.transpose();
  }
  const Eigen::MatrixXd exact = information.inverse();
  const auto smallest = [](const Eigen::Matrix2d& m) {
    return Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(m).eigenvalues()[0];
  };
  for (int i = 0; i < n; ++i) {
    const Eigen::Matrix2d bound = bounds[i].topLeftCorner<2, 2>();
    const Eigen::Matrix2d prior = frame_.lines[i].depth.covariance;
    EXPECT_GT(smallest(bound - exact.block<2, 2>(4 * i, 4 * i)), -1e-12 * bound.trace()) << i;
    EXPECT_GT(smallest(prior - bound), -1e-12 * prior.trace()) << i;
    EXPECT_LT(bound.trace(), prior.trace());
  }
}

TEST_F(FrameStructureFactorsTest, HasExactCovariancesForASinglePair) {
  factors_.parallel.erase(factors_.parallel.begin() + 1, factors_.parallel.end());
  factors_.perpendicular.clear();
  const int i = factors_.parallel[0].i, j = factors_.parallel[0].j;
  StructureEquations equations;
  ASSERT_TRUE(factors_.Linearize(blocks_, &equations));
  Eigen::Matrix<double, 8, 8> information;
  information << equations.diagonal[i], equations.pairs[0].ij, equations.pairs[0].ij.transpose(),
      equations.diagonal[j];
  const Eigen::Matrix<double, 8, 8> exact = information.inverse();
  const auto bounds = BoundCovariances(factors_, equations);
  EXPECT_THAT(bounds[i], IsNear((exact.topLeftCorner<4, 4>()).eval(), 1e-9));
  EXPECT_THAT(bounds[j], IsNear((exact.bottomRightCorner<4, 4>()).eval(), 1e-9));
}

}  // namespace
}  // namespace msc_vo
