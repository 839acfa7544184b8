// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/factors/points_on_plane.h"

#include "tests/factors/plane_block.h"

#include "msc_vo/factors/jacobian_check.h"
#include "msc_vo/factors/plane_manifold.h"
#include "msc_vo/factors/plane_observation.h"
#include "msc_vo/factors/point_reprojection.h"

namespace msc_vo {
namespace {

// The point of the plane that is nearest to x.
Eigen::Vector3d Foot(const Plane& plane, const Eigen::Vector3d& x) {
  return x - (plane.normal().dot(x) + plane.offset()) * plane.normal();
}

TEST(PointsOnPlane, AreZeroOnThePlane) {
  RandomGeometry random(1);
  for (int i = 0; i < 10; ++i) {
    const Plane plane = RandomPlane(&random);
    const LineSegment3 line{Foot(plane, random.Normal3()), Foot(plane, random.Normal3())};
    EXPECT_LT(
        Residual(*CostPtr(PointOnPlane::Create(0.01)), {Block(line.start), Block(plane)}).norm(),
        1e-11);
    EXPECT_LT(Residual(*CostPtr(LineOnPlane::Create(0.01)), {Block(line), Block(plane)}).norm(),
              1e-11);
  }
}

TEST(PointsOnPlane, MatchValuesByHand) {
  // The plane z = 2, its front towards the origin: 0.1 m before it, and 0.2 m behind it.
  const Plane wall({0.0, 0.0, -1.0}, 2.0);
  const LineSegment3 line{{0.3, 0.1, 1.9}, {-0.4, 0.0, 2.2}};
  EXPECT_NEAR(Residual(*CostPtr(PointOnPlane::Create(0.05)), {Block(line.start), Block(wall)})[0],
              2.0, 1e-12);
  EXPECT_THAT(Residual(*CostPtr(LineOnPlane::Create(0.05)), {Block(line), Block(wall)}),
              IsNear(Eigen::Vector2d(2.0, -4.0), 1e-12));
}

TEST(PointsOnPlane, DoNotDependOnMotionOfTheWorld) {
  RandomGeometry random(2);
  const CostPtr cost(LineOnPlane::Create(0.01));
  for (int i = 0; i < 10; ++i) {
    const Plane plane = RandomPlane(&random);
    const LineSegment3 line = random.Line();
    const Rigid3 motion = random.Pose();
    EXPECT_THAT(Residual(*cost, {Block(motion * line), Block(motion * plane)}),
                IsNear(Residual(*cost, {Block(line), Block(plane)}), 1e-9));
  }
}

TEST(PointsOnPlane, DerivativesMatch) {
  RandomGeometry random(3);
  const auto deviation = [](const CostPtr& cost, const Blocks& blocks) {
    return CheckJacobians(*cost, blocks, {nullptr, &kPlaneManifold}).deviation;
  };
  for (int i = 0; i < 5; ++i) {
    const Plane plane = RandomPlane(&random);
    const LineSegment3 line = random.Line();
    const LineSegment3 on_plane{Foot(plane, line.start), Foot(plane, line.end)};
    for (const LineSegment3& x : {line, on_plane}) {
      EXPECT_LT(deviation(CostPtr(PointOnPlane::Create(0.1)), {Block(x.start), Block(plane)}),
                1e-7);
      EXPECT_LT(deviation(CostPtr(LineOnPlane::Create(0.1)), {Block(x), Block(plane)}), 1e-7);
    }
  }
}

TEST(PointsOnPlane, HaveUnitCovarianceUnderTheirNoise) {
  RandomGeometry random(4);
  const double sigma = 0.01;
  const Plane plane = RandomPlane(&random);
  const CostPtr cost(LineOnPlane::Create(sigma));
  std::vector<Eigen::VectorXd> samples;
  for (int i = 0; i < 4000; ++i) {
    const Eigen::Vector2d noise = sigma * random.Normal2();
    const LineSegment3 line{Foot(plane, random.Normal3()) + noise.x() * plane.normal(),
                            Foot(plane, random.Normal3()) + noise.y() * plane.normal()};
    samples.push_back(Residual(*cost, {Block(line), Block(plane)}));
  }
  ExpectIdentityCovariance(samples);
}

// Points of one view without any depth of their own: the observed plane gives it.
TEST(PointsOnPlane, RecoverDepthFromAnObservedPlane) {
  RandomGeometry random(5);
  const PinholeCamera camera{500.0, 500.0, 320.0, 240.0};
  const Plane truth(Eigen::Vector3d(0.3, -0.2, -1.0).normalized(), 2.0);
  Plane plane(Eigen::Vector3d(0.2, -0.1, -1.0).normalized(), 2.2);
  Rigid3 pose;
  PlaneManifold manifold;
  Rigid3Manifold pose_manifold;
  ceres::Problem::Options options;
  options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(options);
  problem.AddParameterBlock(pose.params.data(), 7, &pose_manifold);
  problem.SetParameterBlockConstant(pose.params.data());
  problem.AddParameterBlock(plane.params.data(), 4, &manifold);
  const Eigen::Matrix3d covariance = 1e-5 * Eigen::Matrix3d::Identity();
  problem.AddResidualBlock(
      PlaneObservation::Create(Eigen::Vector3d(-truth.normal() / truth.offset()), covariance),
      nullptr, pose.params.data(), plane.params.data());
  std::vector<Eigen::Vector3d> points(10), true_points;
  for (Eigen::Vector3d& point : points) {
    const Eigen::Vector3d ray(random.Uniform(-0.5, 0.5), random.Uniform(-0.4, 0.4), 1.0);
    true_points.emplace_back(-truth.offset() / truth.normal().dot(ray) * ray);
    point = 1.3 * true_points.back();
    problem.AddResidualBlock(
        PointReprojection::Create(camera, camera.Project(true_points.back()), 0.5), nullptr,
        pose.params.data(), point.data());
    problem.AddResidualBlock(PointOnPlane::Create(0.01), nullptr, point.data(),
                             plane.params.data());
  }
  SolveToEnd(&problem);
  for (size_t i = 0; i < points.size(); ++i) {
    EXPECT_LT((points[i] - true_points[i]).norm(), 1e-7);
  }
}

}  // namespace
}  // namespace msc_vo
