// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/pose_estimation/plane_factors.h"

#include "tests/support/plane_features.h"
#include <ceres/cost_function.h>
#include <gtest/gtest.h>

#include "msc_vo/camera/pinhole_camera.h"
#include "msc_vo/geometry/so3.h"

namespace msc_vo {
namespace {

const Plane kWall({0.6, 0.0, -0.8}, 2.0);

// The plane as a camera sees it whose calibration is wrong: the rays of its pixels are b', those
// of the true one b = A b', and q . b = (A^T q) . b'.
PlaneFeature SeenBy(const PinholeCamera& wrong) {
  const PinholeCamera camera;
  Eigen::Matrix3d a = Eigen::Matrix3d::Identity();
  a(0, 0) = wrong.fx / camera.fx;
  a(0, 2) = (wrong.cx - camera.cx) / camera.fx;
  a(1, 1) = wrong.fy / camera.fy;
  a(1, 2) = (wrong.cy - camera.cy) / camera.fy;
  PlaneFeature feature;
  feature.inverse_depth = a.transpose() * (-kWall.normal() / kWall.offset());
  feature.covariance = 1e-7 * Eigen::Matrix3d::Identity();
  return feature;
}

double SquaredResidual(const PlaneFeature& feature, PlanesBeside beside) {
  MapPlanes map;
  map.planes.push_back({3, kWall, {}});
  const auto factors = MakePlanePoseFactors({feature}, {{0, 3}}, map, beside);
  const Rigid3 pose;
  const double* parameters[] = {pose.params.data()};
  Eigen::Vector3d residual;
  EXPECT_TRUE(factors.at(0).cost->Evaluate(parameters, residual.data(), nullptr));
  return residual.squaredNorm();
}

TEST(PlaneFactors, CountErrorsOfTheCalibrationBesidePointsAndLines) {
  PinholeCamera wrong;
  wrong.fx *= 1.005;
  wrong.fy *= 0.995;
  wrong.cx += 0.01 * wrong.fx;
  const PlaneFeature feature = SeenBy(wrong);
  EXPECT_LT(SquaredResidual(feature, PlanesBeside::kPointsAndLines), 4.0);
  EXPECT_GT(SquaredResidual(feature, PlanesBeside::kNothing), 20.0);
}

TEST(PlaneFactors, LeaveOutPlanesThatAreNotInTheMap) {
  const std::vector<PlaneFeature> features = {SeenBy(PinholeCamera())};
  EXPECT_TRUE(
      MakePlanePoseFactors(features, {{0, 3}}, MapPlanes(), PlanesBeside::kNothing).empty());
}

TEST(PlaneFactors, FitAPlaneToItsViews) {
  const Rigid3 poses[] = {{}, {ExpSO3({0.0, 0.2, 0.1}), {0.3, 0.1, 0.2}}};
  std::vector<PlaneFeature> features;
  for (const Rigid3& pose : poses) features.push_back(FeatureOf(pose * kWall));
  const Rigid3 behind({1, 0, 0, 0}, {0.0, 0.0, -9.0});  // a pose that is wrong
  features.push_back(features[0]);
  const std::vector<PlaneView> views = {
      {poses[0], &features[0]}, {poses[1], &features[1]}, {behind, &features[2]}};
  Plane plane((kWall.normal() + Eigen::Vector3d(0.02, 0.03, -0.01)).normalized(), 1.9);
  FitPlane(views, 1.0, &plane);
  EXPECT_LT((plane.params - kWall.params).norm(), 1e-6);
}

}  // namespace
}  // namespace msc_vo
