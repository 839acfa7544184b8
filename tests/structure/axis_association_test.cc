// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/structure/axis_association.h"

#include "tests/structure/evidence.h"
#include <gtest/gtest.h>

namespace msc_vo {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

// A line at an angle of `degrees` to axis `axis` of `rotation`.
AxisEvidence LineAtAngle(const Quaterniond& rotation, int axis, double degrees,
                         double sigma_degrees) {
  const Vector3d about = rotation * Vector3d::Unit((axis + 1) % 3);
  const Eigen::AngleAxisd turn(DegreesToRadians(degrees), about);
  return {turn * (rotation * Vector3d::Unit(axis)), DegreesToRadians(sigma_degrees)};
}

class AxisAssociationTest : public ::testing::Test {
 protected:
  Random random_{1};
  Quaterniond rotation_ = testing::RandomRotation(&random_);
};

TEST_F(AxisAssociationTest, FindsTheAxisOfALineOfEitherSign) {
  for (int axis = 0; axis < 3; ++axis) {
    AxisEvidence line = LineAtAngle(rotation_, axis, 1.0, 0.5);
    EXPECT_EQ(AssociateAxis(rotation_, 0.0, line), axis);
    line.direction = -line.direction;
    EXPECT_EQ(AssociateAxis(rotation_, 0.0, line), axis);
  }
}

TEST_F(AxisAssociationTest, ScalesTheGateWithTheSigmaOfTheLine) {
  EXPECT_TRUE(AssociateAxis(rotation_, 0.0, LineAtAngle(rotation_, 1, 1.4, 0.5)));
  EXPECT_FALSE(AssociateAxis(rotation_, 0.0, LineAtAngle(rotation_, 1, 1.6, 0.5)));
  EXPECT_TRUE(AssociateAxis(rotation_, 0.0, LineAtAngle(rotation_, 1, 1.6, 0.6)));
}

TEST_F(AxisAssociationTest, ScalesTheGateWithTheSigmaOfTheAxes) {
  const AxisEvidence line = LineAtAngle(rotation_, 2, 3.0, 0.5);
  EXPECT_FALSE(AssociateAxis(rotation_, DegreesToRadians(0.5), line));
  EXPECT_TRUE(AssociateAxis(rotation_, DegreesToRadians(1.0), line));
}

TEST_F(AxisAssociationTest, RejectsLinesBeyondTheLargestAngle) {
  EXPECT_TRUE(AssociateAxis(rotation_, 0.0, LineAtAngle(rotation_, 0, 4.9, 3.0)));
  EXPECT_FALSE(AssociateAxis(rotation_, 0.0, LineAtAngle(rotation_, 0, 5.1, 3.0)));
}

TEST_F(AxisAssociationTest, RejectsUncertainLines) {
  EXPECT_TRUE(AssociateAxis(rotation_, 0.0, LineAtAngle(rotation_, 0, 0.0, 4.9)));
  EXPECT_FALSE(AssociateAxis(rotation_, 0.0, LineAtAngle(rotation_, 0, 0.0, 5.1)));
  EXPECT_FALSE(AssociateAxis(rotation_, 0.0, LineAtAngle(rotation_, 0, 0.0, std::nan(""))));
}

TEST_F(AxisAssociationTest, RejectsDiagonals) {
  const Vector3d diagonal = rotation_ * Vector3d(1, 1, 0).normalized();
  EXPECT_FALSE(AssociateAxis(rotation_, 0.0, {diagonal, DegreesToRadians(5.0)}));
}

TEST_F(AxisAssociationTest, AssociatesOneInAHundredRandomLines) {
  int num_associated = 0;
  for (int i = 0; i < 20000; ++i) {
    const AxisEvidence line = {testing::RandomDirection(&random_), DegreesToRadians(4.0)};
    if (AssociateAxis(rotation_, 0.0, line)) ++num_associated;
  }
  // 3 (1 - cos 5 degrees) of 20000 is 228; its standard deviation is 15.
  EXPECT_NEAR(num_associated, 228, 60);
}

TEST_F(AxisAssociationTest, AssociatesNinetyNineInAHundredLinesOfAnAxis) {
  int num_associated = 0;
  for (int i = 0; i < 10000; ++i) {
    testing::Evidence lines;
    const Vector3d axis = rotation_ * Vector3d::UnitX();
    testing::AddAlong(axis, 1, DegreesToRadians(1.0), &random_, &lines);
    if (AssociateAxis(rotation_, 0.0, lines[0]) == 0) ++num_associated;
  }
  EXPECT_NEAR(num_associated, 9900, 50);
}

}  // namespace
}  // namespace msc_vo
