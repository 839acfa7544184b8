// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/factors/rotation3_manifold.h"

#include "tests/factors/manifold_invariants.h"
#include "tests/support/factor_checks.h"

namespace ceres {  // the macro below uses types without namespace
namespace {

TEST(Rotation3Manifold, SatisfiesManifoldInvariants) {
  const msc_vo::Rotation3Manifold manifold;
  msc_vo::RandomGeometry random(1);
  for (int i = 0; i < 20; ++i) {
    const Vector x = random.Pose().params.head<4>();
    Vector y = random.Pose().params.head<4>();
    // q and -q are the same rotation, but the macro compares coordinates: choose the one closer to
    // x.
    if (x.dot(y) < 0.0) y *= -1.0;
    const Vector delta = 0.8 * random.Normal3();
    EXPECT_THAT_MANIFOLD_INVARIANTS_HOLD(manifold, x, delta, y, 1e-7);
  }
}

}  // namespace
}  // namespace ceres

namespace msc_vo {
namespace {

TEST(Rotation3Manifold, MatchesTheRotationOfRigid3Manifold) {
  RandomGeometry random(2);
  const Rigid3Manifold rigid;
  const Rotation3Manifold rotation;
  for (int i = 0; i < 5; ++i) {
    const Rigid3 pose = random.Pose();
    Eigen::Matrix<double, 6, 1> delta;
    delta << random.Normal3(), random.Normal3();
    Rigid3 moved;
    Eigen::Vector4d q;
    rigid.Plus(pose.params.data(), delta.data(), moved.params.data());
    rotation.Plus(pose.params.data(), delta.data(), q.data());
    EXPECT_EQ(q, Eigen::Vector4d(moved.params.head<4>()));
    EXPECT_NEAR(q.norm(), 1.0, 1e-15);
    Eigen::Matrix<double, 7, 6, Eigen::RowMajor> rigid_plus;
    Eigen::Matrix<double, 4, 3, Eigen::RowMajor> plus;
    rigid.PlusJacobian(pose.params.data(), rigid_plus.data());
    rotation.PlusJacobian(pose.params.data(), plus.data());
    EXPECT_EQ(plus, (rigid_plus.topLeftCorner<4, 3>()));
  }
}

}  // namespace
}  // namespace msc_vo
