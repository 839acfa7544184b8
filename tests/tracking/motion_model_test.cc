// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/tracking/motion_model.h"

#include <gmock/gmock.h>

#include "msc_vo/geometry/so3.h"

namespace msc_vo {
namespace {

TEST(MotionModel, PredictsRestBeforeTheFirstMotion) {
  MotionModel model;
  model.Reset(1.0);
  EXPECT_TRUE(model.Predict(2.0).params.isApprox(Rigid3().params));
}

TEST(MotionModel, ScalesTheVelocityWithTime) {
  MotionModel model;
  model.Reset(1.0);
  const Eigen::Vector3d turn(0.0, 0.02, 0.01);
  model.Observe(1.1, Rigid3(ExpSO3(turn), {0.1, 0.0, -0.2}));
  const Rigid3 twice = model.Predict(1.3);
  EXPECT_TRUE(LogSO3(twice.rotation()).isApprox(2.0 * turn, 1e-9));
  EXPECT_TRUE(twice.translation().isApprox(Eigen::Vector3d(0.2, 0.0, -0.4), 1e-9));
}

TEST(MotionModel, ExtrapolatesBackwards) {
  MotionModel model;
  model.Reset(1.0);
  EXPECT_FALSE(model.VelocityAt(1.0).has_value());
  const Eigen::Vector3d turn(0.0, 0.02, 0.01);
  model.Observe(1.1, Rigid3(ExpSO3(turn), {0.1, 0.0, -0.2}));
  const Rigid3 back = model.VelocityAt(1.2)->Over(-0.05);
  EXPECT_TRUE(LogSO3(back.rotation()).isApprox(-0.5 * turn, 1e-9));
  EXPECT_TRUE(back.translation().isApprox(Eigen::Vector3d(-0.05, 0.0, 0.1), 1e-9));
  EXPECT_FALSE(model.VelocityAt(2.0).has_value());  // too old
}

TEST(MotionModel, InterpolatesTheVelocityAtTheLastFrame) {
  MotionModel model;
  model.Reset(1.0);
  const Rigid3 metre(Eigen::Quaterniond::Identity(), {0.1, 0.0, 0.0});
  EXPECT_NEAR(model.LastVelocity(1.1, metre)->linear.x(), 1.0, 1e-9);  // no earlier motion
  model.Observe(1.1, metre);
  // Mean velocities 1 m/s until 1.1 s and 2.5 m/s until 1.14 s belong to the middles of these
  // intervals, 1.05 s and 1.12 s.
  EXPECT_NEAR(model.LastVelocity(1.14, metre)->linear.x(), 1.0 + 1.5 * 5.0 / 7.0, 1e-9);
  EXPECT_FALSE(model.LastVelocity(1.7, metre).has_value());
  EXPECT_FALSE(model.VelocitySince(1.7, metre).has_value());
}

TEST(MotionModel, LimitsThePredictionOverALongGap) {
  MotionModel model;
  model.Reset(1.0);
  model.Observe(1.1, Rigid3(Eigen::Quaterniond::Identity(), {0.1, 0.0, 0.0}));
  EXPECT_NEAR(model.Predict(100.0).translation().x(), 0.5, 1e-9);
}

}  // namespace
}  // namespace msc_vo
