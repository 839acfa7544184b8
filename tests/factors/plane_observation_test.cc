// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/factors/plane_observation.h"

#include "tests/factors/plane_block.h"

#include "msc_vo/factors/plane_manifold.h"

namespace msc_vo {
namespace {

const Eigen::Matrix3d kCovariance =
    (Eigen::Matrix3d() << 4e-5, 1e-5, -5e-6, 1e-5, 3e-5, 2e-6, -5e-6, 2e-6, 2e-5).finished();

// A plane in front of the camera, which sees its front.
Plane InView(RandomGeometry* random) {
  const Eigen::Vector3d normal =
      (Eigen::Vector3d(0.0, 0.0, -1.0) + 0.4 * random->Normal3()).normalized();
  return {normal, random->Uniform(0.5, 4.0)};
}

Eigen::Vector3d InverseDepth(const Plane& in_cam) { return -in_cam.normal() / in_cam.offset(); }

TEST(PlaneObservation, IsZeroAtTheTruth) {
  RandomGeometry random(1);
  for (int i = 0; i < 10; ++i) {
    const Rigid3 pose = random.Pose();
    const Plane in_cam = InView(&random);
    const CostPtr cost(PlaneObservation::Create(InverseDepth(in_cam), kCovariance));
    EXPECT_LT(Residual(*cost, {Block(pose), Block(pose.Inverse() * in_cam)}).norm(), 1e-9);
  }
}

TEST(PlaneObservation, MatchesValueByHand) {
  // 2 m away and observed at 2.5 m, straight ahead: 0.5 and 0.4 1/m.
  const Plane wall({0.0, 0.0, -1.0}, 2.0);
  const CostPtr cost(PlaneObservation::Create(Eigen::Vector3d(0.0, 0.0, 0.4),
                                              Eigen::Matrix3d(0.01 * Eigen::Matrix3d::Identity())));
  EXPECT_NEAR(Residual(*cost, {Block(Rigid3()), Block(wall)}).norm(), 1.0, 1e-12);
}

TEST(PlaneObservation, DoesNotDependOnMotionAlongThePlane) {
  RandomGeometry random(2);
  const Rigid3 pose = random.Pose();
  const Plane in_cam = InView(&random);
  const Plane plane = pose.Inverse() * in_cam;
  const CostPtr cost(PlaneObservation::Create(Eigen::Vector3d(0.1, 0.2, 0.4), kCovariance));
  const Eigen::Vector3d along = in_cam.normal().unitOrthogonal();
  const Rigid3 moved = Rigid3(ExpSO3(0.4 * in_cam.normal()), 0.7 * along) * pose;
  EXPECT_NEAR(
      Residual(*cost, {Block(moved), Block(plane)}).norm(),
      [&] {
        // The camera has turned about the normal, with the observation.
        const Eigen::Vector3d turned = ExpSO3(0.4 * in_cam.normal()) * InverseDepth(in_cam);
        const CostPtr same(PlaneObservation::Create(Eigen::Vector3d(0.1, 0.2, 0.4), kCovariance));
        const Plane there(-turned.normalized(), 1.0 / turned.norm());
        return Residual(*same, {Block(Rigid3()), Block(there)}).norm();
      }(),
      1e-9);
}

TEST(PlaneObservation, DerivativesMatch) {
  RandomGeometry random(3);
  for (int i = 0; i < 5; ++i) {
    const Rigid3 pose = random.Pose();
    const Plane plane = pose.Inverse() * InView(&random);
    ExpectGradientsMatch(*CostPtr(PlaneObservation::Create(0.3 * random.Normal3(), kCovariance)),
                         {Block(pose), Block(plane)}, &kPlaneManifold);
  }
}

TEST(PlaneObservation, HasUnitCovarianceUnderItsNoise) {
  RandomGeometry random(4);
  const Rigid3 pose = random.Pose();
  const Plane in_cam = InView(&random);
  const Blocks blocks{Block(pose), Block(pose.Inverse() * in_cam)};
  const Eigen::Matrix3d l = kCovariance.llt().matrixL();
  std::vector<Eigen::VectorXd> samples;
  for (int i = 0; i < 4000; ++i) {
    const CostPtr cost(
        PlaneObservation::Create(InverseDepth(in_cam) + l * random.Normal3(), kCovariance));
    samples.push_back(Residual(*cost, blocks));
  }
  ExpectIdentityCovariance(samples);
}

TEST(PlaneObservation, IsUndefinedBehindThePlane) {
  const CostPtr cost(PlaneObservation::Create(Eigen::Vector3d(0.0, 0.0, 0.5), kCovariance));
  EXPECT_FALSE(IsDefined(*cost, {Block(Rigid3()), Block(Plane({0.0, 0.0, -1.0}, -0.1))}));
  EXPECT_TRUE(IsDefined(*cost, {Block(Rigid3()), Block(Plane({0.0, 0.0, -1.0}, 0.1))}));
}

// Three walls that two cameras see: the pose of the second follows, and so do the walls.
TEST(PlaneObservation, RecoversAPoseFromThreePlanes) {
  RandomGeometry random(5);
  const Rigid3 truth(ExpSO3({0.1, -0.2, 0.05}), {0.3, -0.1, 0.2});
  std::vector<Plane> planes{{Eigen::Vector3d(0.2, 0.1, -1.0).normalized(), 2.0},
                            {Eigen::Vector3d(-1.0, 0.0, -0.3).normalized(), 1.5},
                            {Eigen::Vector3d(0.1, -1.0, -0.2).normalized(), 1.2}};
  const std::vector<Plane> true_planes = planes;
  Rigid3 first, second = Moved(truth, {0.05, 0.04, -0.03}, {0.1, -0.1, 0.05});
  const Rigid3Manifold pose_manifold;
  const PlaneManifold manifold;
  ceres::Problem::Options options;
  options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(options);
  problem.AddParameterBlock(first.params.data(), 7, const_cast<Rigid3Manifold*>(&pose_manifold));
  problem.AddParameterBlock(second.params.data(), 7, const_cast<Rigid3Manifold*>(&pose_manifold));
  problem.SetParameterBlockConstant(first.params.data());
  for (size_t i = 0; i < planes.size(); ++i) {
    planes[i].params[3] += 0.05;
    double* plane = planes[i].params.data();
    problem.AddParameterBlock(plane, 4, const_cast<PlaneManifold*>(&manifold));
    problem.AddResidualBlock(PlaneObservation::Create(InverseDepth(true_planes[i]), kCovariance),
                             nullptr, first.params.data(), plane);
    problem.AddResidualBlock(
        PlaneObservation::Create(InverseDepth(truth * true_planes[i]), kCovariance), nullptr,
        second.params.data(), plane);
  }
  SolveToEnd(&problem);
  EXPECT_LT(Distance(second, truth), 1e-8);
  for (size_t i = 0; i < planes.size(); ++i) {
    EXPECT_LT((planes[i].params - true_planes[i].params).norm(), 1e-8);
  }
}

}  // namespace
}  // namespace msc_vo
