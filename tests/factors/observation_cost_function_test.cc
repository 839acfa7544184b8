// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/factors/observation_cost_function.h"

#include "tests/support/factor_checks.h"
#include <ceres/crs_matrix.h>
#include <ceres/loss_function.h>

#include "msc_vo/factors/depth_reprojection.h"
#include "msc_vo/factors/point_reprojection.h"

namespace msc_vo {
namespace {

using PointObservation = ObservationCostFunction<PointReprojection, DepthReprojection>;
constexpr double kThreshold = 2.0;
constexpr double kDepthThreshold = 1.5;

// What a Gauss-Newton solver makes of residual blocks over a pose and a point.
struct Equations {
  double cost = 0.0;
  Eigen::VectorXd gradient;
  Eigen::MatrixXd hessian;
};

Equations EquationsOf(ceres::Problem* problem) {
  Equations equations;
  std::vector<double> residuals;
  ceres::CRSMatrix crs;
  EXPECT_TRUE(problem->Evaluate({}, &equations.cost, &residuals, nullptr, &crs));
  Eigen::MatrixXd j = Eigen::MatrixXd::Zero(crs.num_rows, crs.num_cols);
  for (int row = 0; row < crs.num_rows; ++row) {
    for (int k = crs.rows[row]; k < crs.rows[row + 1]; ++k) j(row, crs.cols[k]) = crs.values[k];
  }
  equations.gradient = j.transpose() * Eigen::Map<Eigen::VectorXd>(residuals.data(), crs.num_rows);
  equations.hessian = j.transpose() * j;
  return equations;
}

// A point observed with errors in standard deviations.
class ObservationCostFunctionTest : public ::testing::Test {
 protected:
  ObservationCostFunctionTest() {
    x_in_cam_ = random_.InView();
    pose_ = random_.Pose();
    point_ = pose_.Inverse() * x_in_cam_;
  }
  PointReprojection Reprojection(double error) const {
    const Eigen::Vector2d pixel = camera_.Project(x_in_cam_);
    return {camera_, pixel + 0.5 * error * Eigen::Vector2d(0.6, 0.8), 0.5};
  }
  DepthReprojection Depth(double error) const { return {1.0 / x_in_cam_.z() + 0.01 * error, 0.01}; }
  PointObservation Cost(double error, double depth_error) const {
    return {Reprojection(error), {kThreshold}, Depth(depth_error), {kDepthThreshold}};
  }
  Equations OfOneBlock(double error, double depth_error) {
    ceres::Problem problem;
    problem.AddResidualBlock(new PointObservation(Cost(error, depth_error)), nullptr,
                             pose_.params.data(), point_.data());
    return EquationsOf(&problem);
  }
  Equations OfTwoBlocks(double error, double depth_error) {
    ceres::Problem problem;
    problem.AddResidualBlock(new AnalyticCostFunction<PointReprojection>(Reprojection(error)),
                             new ceres::HuberLoss(kThreshold), pose_.params.data(), point_.data());
    problem.AddResidualBlock(new AnalyticCostFunction<DepthReprojection>(Depth(depth_error)),
                             new ceres::HuberLoss(kDepthThreshold), pose_.params.data(),
                             point_.data());
    return EquationsOf(&problem);
  }

  PinholeCamera camera_;
  RandomGeometry random_{5};
  Eigen::Vector3d x_in_cam_, point_;
  Rigid3 pose_;
};

TEST_F(ObservationCostFunctionTest, HasTheEquationsOfTwoResidualBlocks) {
  for (const double error : {0.0, 1.0, 1.999, 2.001, 30.0}) {
    for (const double depth_error : {0.5, 1.499, 1.501, -20.0}) {
      SCOPED_TRACE(testing::Message() << error << " " << depth_error);
      const Equations one = OfOneBlock(error, depth_error);
      const Equations two = OfTwoBlocks(error, depth_error);
      EXPECT_NEAR(one.cost, two.cost, 1e-12 * (1.0 + two.cost));
      EXPECT_THAT(one.gradient, IsNear(two.gradient, 1e-11 * (1.0 + two.gradient.norm())));
      EXPECT_THAT(one.hessian, IsNear(two.hessian, 1e-12 * two.hessian.norm()));
    }
  }
}

TEST_F(ObservationCostFunctionTest, HasARowForTheCostBeyondTheThresholds) {
  const Blocks blocks{Block(pose_), Block(point_)};
  EXPECT_EQ(Residual(Cost(1.0, 1.0), blocks)[3], 0.0);
  // rho(s) - rho'(s) s = 2 t |r| - t^2 - t |r| = 2 (5 - 2) for |r| = 5, t = 2
  EXPECT_NEAR(Residual(Cost(5.0, 1.0), blocks)[3], std::sqrt(6.0), 1e-9);
}

TEST_F(ObservationCostFunctionTest, EvaluatesEachJacobianSeparately) {
  const PointObservation cost = Cost(5.0, 3.0);
  const Blocks blocks{Block(pose_), Block(point_)};
  ExpectEachJacobianSeparately(cost, blocks);
}

TEST_F(ObservationCostFunctionTest, IsUndefinedBehindTheCameraAndWhereTheCostOverflows) {
  EXPECT_FALSE(IsDefined(Cost(1e200, 0.0), {Block(pose_), Block(point_)}));
  x_in_cam_.z() = -1.0;
  EXPECT_FALSE(IsDefined(Cost(0.0, 0.0), {Block(pose_), Block(pose_.Inverse() * x_in_cam_)}));
}

}  // namespace
}  // namespace msc_vo
