// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// The chain rule of an observation against automatic differentiation.

#include "msc_vo/factors/camera_linearization.h"

#include "tests/support/factor_checks.h"

#include "msc_vo/factors/camera_equations.h"
#include "msc_vo/factors/depth_reprojection.h"
#include "msc_vo/factors/line_depth_reprojection.h"
#include "msc_vo/factors/line_reprojection.h"
#include "msc_vo/factors/point_reprojection.h"

namespace msc_vo {
namespace {

class CameraLinearizationTest : public ::testing::Test {
 protected:
  CameraLinearizationTest() {
    camera_.fy = -500.0;
    pose_ = random_.Pose();
    const Eigen::Vector3d a = pose_.Inverse() * random_.InView();
    const Eigen::Vector3d b = pose_.Inverse() * random_.InView();
    point_ = a;
    line_ = {a, b};
    part_.start = 0.2;
    part_.end = 0.7;
  }
  LineReprojection Line() const {
    LineReprojection factor(camera_, segment_, 1.0, 2.0);
    factor.SetPart(part_);
    return factor;
  }
  LineDepthReprojection LineDepthFactor() const {
    LineDepth depth;
    depth.start = 0.4;
    depth.end = 0.6;
    LineDepthReprojection factor(camera_, segment_, depth, 0.01, 0.02);
    factor.SetPart(part_);
    return factor;
  }
  PointReprojection Point() const { return {camera_, {300.0, 200.0}, 2.0}; }
  DepthReprojection Depth() const { return {0.5, 0.1}; }

  // Residual and derivatives in tangent space by automatic differentiation: pose, landmark.
  template <typename Factor>
  Linearization Automatic(const Factor& factor, const std::vector<double>& landmark) const {
    Linearization at = Linearize(*CostPtr(Factor::Create(factor)), {Block(pose_), landmark});
    Eigen::Matrix<double, 7, 6, Eigen::RowMajor> plus;
    Rigid3Manifold().PlusJacobian(pose_.params.data(), plus.data());
    at.jacobians[0] = (at.jacobians[0] * plus).eval();
    return at;
  }

  template <typename Factor>
  void ExpectRowsByPose(const Factor& factor, const std::vector<double>& landmark) const {
    CameraPoints<Factor::kNumPoints> points;
    ASSERT_TRUE(points.Set(factor, Rotation(), pose_.translation(), landmark.data()));
    const CameraLinearization<Factor> at = LinearizeInCamera(factor, points);
    const Linearization expected = Automatic(factor, landmark);
    EXPECT_THAT(at.residual, IsNear(expected.residual, 1e-9));
    for (int row = 0; row < Factor::kNumResiduals; ++row) {
      const int k = row / Factor::kRowsPerPoint;
      const Eigen::Vector3d by_x = at.by_x[k].row(row % Factor::kRowsPerPoint);
      Eigen::Matrix<double, 1, 6> j;
      j << points.rotated[k].cross(by_x).transpose(), by_x.transpose();
      EXPECT_THAT(j, IsNear(expected.jacobians[0].row(row), 1e-9 * (1.0 + j.norm())));
    }
  }

  template <typename Reprojection, typename Depth>
  void ExpectEquations(const Reprojection& reprojection, const Depth& depth,
                       const std::vector<double>& landmark) const {
    constexpr int kPoints = Reprojection::kNumPoints, kSize = 3 * kPoints;
    const HuberLoss loss{1.0}, depth_loss{1e9};  // the first of them is active
    CameraPoints<kPoints> points;
    ASSERT_TRUE(points.Set(reprojection, Rotation(), pose_.translation(), landmark.data()));
    CameraEquations<kPoints> at;
    at.Add(reprojection, loss, points);
    at.Add(depth, depth_loss, points);

    Eigen::Matrix<double, 6 + kSize, 6 + kSize> hessian;
    Eigen::Matrix<double, 6 + kSize, 1> gradient;
    hessian.setZero();
    gradient.setZero();
    double cost = 0.0;
    const auto add = [&](const Linearization& a, const HuberLoss& of) {
      Eigen::MatrixXd j(a.residual.size(), 6 + kSize);
      j << a.jacobians[0], a.jacobians[1];
      const double s = a.residual.squaredNorm();
      hessian += of.Weight(s) * j.transpose() * j;
      gradient += of.Weight(s) * j.transpose() * a.residual;
      cost += 0.5 * of.Cost(s);
    };
    add(Automatic(reprojection, landmark), loss);
    add(Automatic(depth, landmark), depth_loss);
    ASSERT_LT(loss.Weight(Automatic(reprojection, landmark).residual.squaredNorm()), 1.0);

    Eigen::Matrix<double, 6, 6> pose_hessian = Eigen::Matrix<double, 6, 6>::Zero();
    Eigen::Matrix<double, 6, 1> pose_gradient = Eigen::Matrix<double, 6, 1>::Zero();
    Eigen::Matrix<double, kSize, kSize> landmark_hessian;
    Eigen::Matrix<double, kSize, 1> landmark_gradient;
    Eigen::Matrix<double, 6, kSize> coupling;
    landmark_hessian.setZero();
    landmark_gradient.setZero();
    coupling.setZero();
    at.AddTo({&pose_hessian, &pose_gradient, &landmark_hessian, &landmark_gradient, &coupling},
             reprojection, Rotation(), points);
    const double tolerance = 1e-10 * (1.0 + hessian.norm());
    EXPECT_NEAR(at.cost, cost, 1e-10 * cost);
    // Of the pose, the lower triangle.
    const Eigen::MatrixXd lower = pose_hessian.template selfadjointView<Eigen::Lower>();
    EXPECT_THAT(lower, IsNear(hessian.template topLeftCorner<6, 6>(), tolerance));
    EXPECT_THAT(landmark_hessian,
                IsNear(hessian.template bottomRightCorner<kSize, kSize>(), tolerance));
    EXPECT_THAT(coupling, IsNear(hessian.template topRightCorner<6, kSize>(), tolerance));
    EXPECT_THAT(pose_gradient, IsNear(gradient.template head<6>(), tolerance));
    EXPECT_THAT(landmark_gradient, IsNear(gradient.template tail<kSize>(), tolerance));
  }

  Eigen::Matrix3d Rotation() const { return pose_.rotation().toRotationMatrix(); }

  PinholeCamera camera_;
  RandomGeometry random_{7};
  Rigid3 pose_;
  Eigen::Vector3d point_;
  LineSegment3 line_;
  LineSegment2 segment_{{100.0, 120.0}, {300.0, 400.0}};
  LinePart part_;
};

TEST_F(CameraLinearizationTest, HasTheRowsOfAutomaticDifferentiation) {
  ExpectRowsByPose(Point(), Block(point_));
  ExpectRowsByPose(Depth(), Block(point_));
  ExpectRowsByPose(Line(), Block(line_));
  ExpectRowsByPose(LineDepthFactor(), Block(line_));
}

TEST_F(CameraLinearizationTest, HasTheNormalEquationsOfAutomaticDifferentiation) {
  ExpectEquations(Point(), Depth(), Block(point_));
  ExpectEquations(Line(), LineDepthFactor(), Block(line_));
}

TEST_F(CameraLinearizationTest, IsUndefinedIfAnyPointIsBehindTheCamera) {
  line_.end = pose_.Inverse() * Eigen::Vector3d(0.1, 0.2, -1.0);
  CameraPoints<2> points;
  const LineReprojection whole(camera_, segment_, 1.0, 2.0);
  EXPECT_FALSE(points.Set(whole, Rotation(), pose_.translation(), Block(line_).data()));
  part_ = {0.0, 0.1};  // the part in front
  EXPECT_TRUE(points.Set(Line(), Rotation(), pose_.translation(), Block(line_).data()));
}

}  // namespace
}  // namespace msc_vo
