// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/pose_estimation/pose_factors.h"

#include <memory>

#include "tests/support/factor_checks.h"
#include "tests/support/test_window.h"
#include <ceres/crs_matrix.h>
#include <ceres/loss_function.h>

#include "msc_vo/bundle_adjustment/observation.h"

namespace msc_vo {
namespace {

// Factors of all matches of one frame, including outliers, with robust losses.
PoseFactors MakeFactors(const PoseData& data) {
  PoseFactors factors;
  factors.Of<PointReprojection>().huber = factors.Of<LineReprojection>().huber = 2.448;
  factors.Of<DepthReprojection>().huber = 1.96;
  factors.Of<LineDepthReprojection>().huber = 2.448;
  for (const PoseData::Point& p : data.points) {
    factors.Of<PointReprojection>().blocks.push_back(
        {PointReprojection(data.camera, p.pixel, p.sigma), p.position});
    factors.Of<DepthReprojection>().blocks.push_back(
        {DepthReprojection(p.inverse_depth, p.inverse_depth_sigma), p.position});
  }
  for (const PoseData::Line& l : data.lines) {
    const LineSegment3 line = data.cam_from_world * l.map_segment;
    Eigen::Matrix<double, 6, 1> ends;
    ends << l.map_segment.start, l.map_segment.end;
    factors.Of<LineReprojection>().blocks.push_back(
        {MakeLineReprojection(data.camera, l.segment, l.sigma, line), ends});
    factors.Of<LineDepthReprojection>().blocks.push_back(
        {MakeLineDepthReprojection(data.camera, l.segment, l.depth, line), ends});
  }
  return factors;
}

// Reference: the same factors as a Ceres problem.
class CeresForm {
 public:
  CeresForm(const PoseFactors& factors, const Rigid3& pose) : pose_(pose) {
    problem_.AddParameterBlock(pose_.params.data(), 7, new Rigid3Manifold);
    Add(factors.Of<PointReprojection>());
    Add(factors.Of<DepthReprojection>());
    Add(factors.Of<LineReprojection>());
    Add(factors.Of<LineDepthReprojection>());
  }

  NormalEquations Linearize() {
    ceres::Problem::EvaluateOptions options;
    options.parameter_blocks = {pose_.params.data()};
    NormalEquations equations;
    std::vector<double> gradient;
    ceres::CRSMatrix jacobian;
    EXPECT_TRUE(problem_.Evaluate(options, &equations.cost, nullptr, &gradient, &jacobian));
    equations.gradient = Eigen::Map<Eigen::Matrix<double, 6, 1>>(gradient.data());
    const Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>> j(
        jacobian.values.data(), jacobian.num_rows, 6);
    equations.hessian = j.transpose() * j;
    return equations;
  }

  Rigid3 Solve() {
    SolveToEnd(&problem_);
    return pose_;
  }

 private:
  template <typename Factor>
  void Add(const PoseTerm<Factor>& term) {
    for (const auto& block : term.blocks) {
      landmarks_.push_back(std::make_unique<std::array<double, 6>>());
      double* landmark = landmarks_.back()->data();
      std::copy(block.landmark.begin(), block.landmark.end(), landmark);
      problem_.AddResidualBlock(Factor::Create(block.factor), new ceres::HuberLoss(term.huber),
                                pose_.params.data(), landmark);
      problem_.SetParameterBlockConstant(landmark);
    }
  }

  Rigid3 pose_;
  std::vector<std::unique_ptr<std::array<double, 6>>> landmarks_;
  ceres::Problem problem_;
};

class PoseFactorsTest : public ::testing::TestWithParam<double> {
 protected:
  PoseFactorsTest() {
    TestWindowOptions options;
    options.fy = GetParam();
    options.num_points = 60;
    options.num_lines = 20;
    options.outlier_ratio = 0.1;
    data_ = MakePoseData(MakeTestWindow(options), 4);
    factors_ = MakeFactors(data_);
  }
  PoseData data_;
  PoseFactors factors_;
};
INSTANTIATE_TEST_SUITE_P(FocalLength, PoseFactorsTest, ::testing::Values(525.0, -480.0));

TEST_P(PoseFactorsTest, CountsResidualRows) {
  EXPECT_EQ(factors_.NumRows(), 60 * (2 + 1) + 20 * (2 + 2));
}

TEST_P(PoseFactorsTest, NormalEquationsMatchCeres) {
  NormalEquations ours;
  ASSERT_TRUE(factors_.Linearize(data_.cam_from_world, &ours));
  const NormalEquations ceres = CeresForm(factors_, data_.cam_from_world).Linearize();
  EXPECT_NEAR(ours.cost, ceres.cost, 1e-10 * ceres.cost);
  EXPECT_THAT(ours.gradient, IsNear(ceres.gradient, 1e-10 * ceres.gradient.norm()));
  EXPECT_THAT(ours.hessian, IsNear(ceres.hessian, 1e-10 * ceres.hessian.norm()));
}

TEST_P(PoseFactorsTest, MinimumMatchesCeres) {
  Rigid3 pose = data_.cam_from_world;
  EXPECT_EQ(MinimizePose(factors_, 50, &pose), LevenbergMarquardtTermination::kConverged);
  const Rigid3 ceres = CeresForm(factors_, data_.cam_from_world).Solve();
  // A thousandth of the standard deviation of the pose, which is about 1 mm.
  EXPECT_LT(Distance(pose, ceres), 1e-6);
}

TEST_P(PoseFactorsTest, ReportsTheIterationLimit) {
  Rigid3 pose = data_.cam_from_world;
  EXPECT_EQ(MinimizePose(factors_, 1, &pose), LevenbergMarquardtTermination::kIterationLimit);
}

TEST_P(PoseFactorsTest, FailsWithUnchangedPoseWhereAFactorIsUndefined) {
  const Rigid3 behind(Eigen::Quaterniond::Identity(), {0.0, 0.0, -10.0});
  Rigid3 pose = behind;
  EXPECT_EQ(MinimizePose(factors_, 10, &pose), LevenbergMarquardtTermination::kFailed);
  EXPECT_EQ(pose.params, behind.params);
}

}  // namespace
}  // namespace msc_vo
