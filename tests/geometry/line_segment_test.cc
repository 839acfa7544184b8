// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/geometry/line_segment.h"

#include "tests/support/eigen_matchers.h"
#include <gtest/gtest.h>

#include "msc_vo/geometry/so3.h"

namespace msc_vo {
namespace {

TEST(LineSegment, MeasuresLengthDirectionAndDistance) {
  const LineSegment3 segment{{1.0, 2.0, 3.0}, {1.0, 2.0, 7.0}};
  EXPECT_DOUBLE_EQ(segment.Length(), 4.0);
  EXPECT_EQ(segment.Direction(), Eigen::Vector3d(0.0, 0.0, 1.0));
  EXPECT_EQ(segment.Midpoint(), Eigen::Vector3d(1.0, 2.0, 5.0));
  EXPECT_EQ(segment.At(-0.5), Eigen::Vector3d(1.0, 2.0, 1.0));
  EXPECT_DOUBLE_EQ(segment.Parameter({5.0, 5.0, 4.0}), 0.25);
  EXPECT_DOUBLE_EQ(segment.Parameter({5.0, 5.0, 9.0}), 1.5);
  EXPECT_DOUBLE_EQ(segment.DistanceToLine({4.0, 6.0, -9.0}), 5.0);
}

TEST(LineSegment, TransformAppliesToBothEndPoints) {
  const Rigid3 pose(ExpSO3({0.1, 0.2, 0.3}), {1.0, 2.0, 3.0});
  const LineSegment3 segment{{1.0, 2.0, 3.0}, {1.0, 2.0, 7.0}};
  const LineSegment3 moved = pose * segment;
  EXPECT_THAT(moved.start, IsNear(pose * Eigen::Vector3d(1.0, 2.0, 3.0), 1e-15));
  EXPECT_THAT(moved.end, IsNear(pose * Eigen::Vector3d(1.0, 2.0, 7.0), 1e-15));
}

TEST(ImageLine, GivesSignedDistanceInPixels) {
  const LineSegment2 segment{{10.0, 10.0}, {40.0, 50.0}};
  const Eigen::Vector3d line = ImageLine(segment);
  EXPECT_NEAR(line.head<2>().norm(), 1.0, 1e-15);
  const auto distance = [&](const Eigen::Vector2d& p) { return line.head<2>().dot(p) + line.z(); };
  EXPECT_NEAR(distance(segment.At(-2.0)), 0.0, 1e-12);
  EXPECT_NEAR(distance(segment.At(0.7)), 0.0, 1e-12);
  // (-4, 3) / 5 is the normal.
  EXPECT_NEAR(distance(segment.At(0.5) + Eigen::Vector2d(-4.0, 3.0)), 5.0, 1e-12);
  EXPECT_NEAR(distance(segment.At(0.5) - Eigen::Vector2d(-4.0, 3.0)), -5.0, 1e-12);
}

TEST(ClipToNear, ClipsPartBehindPlane) {
  LineSegment3 segment{{0.0, 0.0, -1.0}, {4.0, 0.0, 3.0}};
  ASSERT_TRUE(ClipToNear(1.0, &segment));
  EXPECT_THAT(segment.start, IsNear(Eigen::Vector3d(2.0, 0.0, 1.0), 1e-15));
  EXPECT_THAT(segment.end, IsNear(Eigen::Vector3d(4.0, 0.0, 3.0), 1e-15));
  segment = {{4.0, 0.0, 3.0}, {0.0, 0.0, -1.0}};
  ASSERT_TRUE(ClipToNear(1.0, &segment));
  EXPECT_THAT(segment.start, IsNear(Eigen::Vector3d(4.0, 0.0, 3.0), 1e-15));
  EXPECT_THAT(segment.end, IsNear(Eigen::Vector3d(2.0, 0.0, 1.0), 1e-15));
}

TEST(ClipToNear, KeepsSegmentInFrontAndRejectsSegmentBehind) {
  LineSegment3 segment{{0.0, 0.0, 1.0}, {4.0, 0.0, 3.0}};
  ASSERT_TRUE(ClipToNear(1.0, &segment));
  EXPECT_EQ(segment.start, Eigen::Vector3d(0.0, 0.0, 1.0));
  EXPECT_EQ(segment.end, Eigen::Vector3d(4.0, 0.0, 3.0));
  segment = {{0.0, 0.0, 0.5}, {4.0, 0.0, 0.9}};
  EXPECT_FALSE(ClipToNear(1.0, &segment));
}

class ClipToImageTest : public ::testing::Test {
 protected:
  const PinholeCamera camera_ = PinholeCamera();  // 640 x 480: the rectangle [0, 639] x [0, 479]
};

TEST_F(ClipToImageTest, KeepsSegmentInside) {
  LineSegment2 segment{{10.0, 20.0}, {600.0, 400.0}};
  ASSERT_TRUE(ClipToImage(camera_, &segment));
  EXPECT_EQ(segment.start, Eigen::Vector2d(10.0, 20.0));
  EXPECT_EQ(segment.end, Eigen::Vector2d(600.0, 400.0));
}

TEST_F(ClipToImageTest, ClipsAtOneAndTwoBorders) {
  LineSegment2 segment{{-100.0, 100.0}, {100.0, 200.0}};
  ASSERT_TRUE(ClipToImage(camera_, &segment));
  EXPECT_THAT(segment.start, IsNear(Eigen::Vector2d(0.0, 150.0), 1e-12));
  EXPECT_THAT(segment.end, IsNear(Eigen::Vector2d(100.0, 200.0), 1e-12));
  segment = {{300.0, 579.0}, {300.0, -100.0}};
  ASSERT_TRUE(ClipToImage(camera_, &segment));
  EXPECT_THAT(segment.start, IsNear(Eigen::Vector2d(300.0, 479.0), 1e-12));
  EXPECT_THAT(segment.end, IsNear(Eigen::Vector2d(300.0, 0.0), 1e-12));
}

TEST_F(ClipToImageTest, RejectsSegmentOutside) {
  LineSegment2 segment{{-10.0, 20.0}, {-10.0, 400.0}};  // left of the image, upright
  EXPECT_FALSE(ClipToImage(camera_, &segment));
  segment = {{-100.0, 50.0}, {50.0, -100.0}};  // passes by the corner
  EXPECT_FALSE(ClipToImage(camera_, &segment));
  segment = {{700.0, 50.0}, {800.0, 60.0}};
  EXPECT_FALSE(ClipToImage(camera_, &segment));
}

}  // namespace
}  // namespace msc_vo
