// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/factors/rigid3_manifold.h"

#include "tests/factors/manifold_invariants.h"
#include "tests/support/factor_checks.h"

namespace ceres {  // the macro below uses types without namespace
namespace {

TEST(Rigid3Manifold, SatisfiesManifoldInvariants) {
  const msc_vo::Rigid3Manifold manifold;
  msc_vo::RandomGeometry random(1);
  for (int i = 0; i < 20; ++i) {
    const Vector x = random.Pose().params;
    Vector y = random.Pose().params;
    // q and -q are the same rotation, but the macro compares coordinates: choose the one closer to
    // x.
    if (x.head<4>().dot(y.head<4>()) < 0.0) y.head<4>() *= -1.0;
    Vector delta(6);
    delta << 0.8 * random.Normal3(), random.Normal3();
    EXPECT_THAT_MANIFOLD_INVARIANTS_HOLD(manifold, x, delta, y, 1e-7);
  }
}

}  // namespace
}  // namespace ceres

namespace msc_vo {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;

TEST(Rigid3Manifold, TangentIsTheRotationVectorInTheTargetFrameAndTheTranslation) {
  // A quarter turn about the camera's z axis maps x to y.
  const Rigid3 pose(Eigen::Quaterniond::Identity(), {1.0, 2.0, 3.0});
  const Vector6 delta = (Vector6() << 0, 0, 0.5 * std::acos(-1.0), 0.1, 0.2, 0.3).finished();
  Rigid3 moved;
  Rigid3Manifold().Plus(pose.params.data(), delta.data(), moved.params.data());
  EXPECT_THAT(moved.rotation() * Eigen::Vector3d::UnitX(), IsNear(Eigen::Vector3d::UnitY(), 1e-15));
  EXPECT_THAT(moved.translation(), IsNear(Eigen::Vector3d(1.1, 2.2, 3.3), 1e-15));
}

TEST(Rigid3Manifold, MinusIgnoresTheSignOfTheQuaternion) {
  RandomGeometry random(2);
  const Rigid3 x = random.Pose(), y = random.Pose();
  Rigid3 negative = y;
  negative.params.head<4>() *= -1.0;
  Vector6 a, b;
  Rigid3Manifold().Minus(y.params.data(), x.params.data(), a.data());
  Rigid3Manifold().Minus(negative.params.data(), x.params.data(), b.data());
  EXPECT_THAT(a, IsNear(b, 1e-12));
}

TEST(Rigid3Manifold, QuaternionKeepsUnitNormOverManySteps) {
  RandomGeometry random(3);
  Rigid3 pose = random.Pose();
  for (int i = 0; i < 1000; ++i) {
    Vector6 delta;
    delta << random.Normal3(), random.Normal3();
    Rigid3Manifold().Plus(pose.params.data(), delta.data(), pose.params.data());
  }
  EXPECT_NEAR(pose.rotation().norm(), 1.0, 1e-15);
}

}  // namespace
}  // namespace msc_vo
