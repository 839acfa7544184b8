// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/factors/unit_vector_manifold.h"

#include "tests/factors/manifold_invariants.h"
#include "tests/factors/plane_block.h"

namespace ceres {  // the macro below uses types without namespace
namespace {

TEST(UnitVectorManifold, SatisfiesManifoldInvariants) {
  const msc_vo::UnitVectorManifold manifold;
  msc_vo::RandomGeometry random(1);
  for (int i = 0; i < 20; ++i) {
    const Vector x = random.Normal3().normalized(), y = random.Normal3().normalized();
    const Vector delta = 0.8 * random.Normal3().head<2>();
    EXPECT_THAT_MANIFOLD_INVARIANTS_HOLD(manifold, x, delta, y, 1e-7);
  }
}

}  // namespace
}  // namespace ceres

namespace msc_vo {
namespace {

TEST(UnitVectorManifold, TangentIsTheAngle) {
  RandomGeometry random(2);
  for (const double angle : {1e-6, 0.3, 2.0}) {
    const Plane plane = RandomPlane(&random);
    const Eigen::Vector2d delta = angle * random.Normal3().head<2>().normalized();
    Eigen::Vector3d moved;
    UnitVectorManifold().Plus(plane.params.data(), delta.data(), moved.data());
    EXPECT_NEAR(moved.norm(), 1.0, 1e-15);
    EXPECT_NEAR(plane.normal().cross(moved).norm(), std::sin(angle), 1e-15);
    EXPECT_NEAR(plane.normal().dot(moved), std::cos(angle), 1e-15);
    // So is that of the normal of a plane, beside its offset.
    const Eigen::Vector3d of_plane(delta.x(), delta.y(), 0.4);
    Plane moved_plane;
    kPlaneManifold.Plus(plane.params.data(), of_plane.data(), moved_plane.params.data());
    EXPECT_EQ(moved_plane.normal(), moved);
    EXPECT_NEAR(moved_plane.offset(), plane.offset() + 0.4, 1e-15);
  }
}

}  // namespace
}  // namespace msc_vo
