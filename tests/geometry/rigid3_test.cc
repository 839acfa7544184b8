// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/geometry/rigid3.h"

#include <cmath>

#include "tests/support/eigen_matchers.h"
#include <gtest/gtest.h>

#include "msc_vo/geometry/so3.h"

namespace msc_vo {
namespace {

const Rigid3 kPose(ExpSO3({0.4, -0.3, 0.9}), {1.0, -2.0, 3.0});
const Rigid3 kOther(ExpSO3({-0.2, 0.8, 0.1}), {0.5, 0.7, -0.6});
const Eigen::Vector3d kPoint(0.3, -0.4, 2.0);

TEST(Rigid3, DefaultIsIdentity) { EXPECT_EQ(Rigid3() * kPoint, kPoint); }

TEST(Rigid3, MatchesKnownTransform) {
  // A rotation by 90 degrees about z, then a translation.
  const Rigid3 pose(ExpSO3({0.0, 0.0, 2.0 * std::atan(1.0)}), {10.0, 20.0, 30.0});
  EXPECT_THAT(pose * Eigen::Vector3d(1.0, 2.0, 3.0),
              IsNear(Eigen::Vector3d(8.0, 21.0, 33.0), 1e-14));
}

TEST(Rigid3, ParametersAreQuaternionXyzwThenTranslation) {
  const Rigid3 pose(Eigen::Quaterniond(0.5, -0.5, 0.5, -0.5), {1.0, 2.0, 3.0});  // w first here
  const Eigen::Matrix<double, 7, 1> expected =
      (Eigen::Matrix<double, 7, 1>() << -0.5, 0.5, -0.5, 0.5, 1.0, 2.0, 3.0).finished();
  EXPECT_EQ(pose.params, expected);
}

TEST(Rigid3, InverseAndComposition) {
  EXPECT_THAT(kPose.Inverse() * (kPose * kPoint), IsNear(kPoint, 1e-14));
  EXPECT_THAT((kPose * kOther) * kPoint, IsNear(kPose * (kOther * kPoint), 1e-14));
  EXPECT_THAT((kPose * kPose.Inverse()) * kPoint, IsNear(kPoint, 1e-14));
}

TEST(Rigid3, OriginInSourceIsCameraCentre) {
  EXPECT_THAT(kPose * kPose.OriginInSource(), IsNear(Eigen::Vector3d::Zero().eval(), 1e-14));
}

TEST(Rigid3, RemainsRigidInLongProducts) {
  Rigid3 chain;
  for (int i = 0; i < 10000; ++i) chain = chain * kPose;
  EXPECT_NEAR(chain.rotation().norm(), 1.0, 1e-14);
}

}  // namespace
}  // namespace msc_vo
