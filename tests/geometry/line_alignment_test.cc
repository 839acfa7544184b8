// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/geometry/line_alignment.h"

#include <utility>

#include "tests/geometry/alignment_truth.h"
#include <gtest/gtest.h>

#include "msc_vo/geometry/angles.h"
#include "msc_vo/geometry/so3.h"

namespace msc_vo {
namespace {

using Vec = Eigen::Vector3d;

const AlignmentTolerance kTolerance{DegreesToRadians(5.0), 0.02};

// A horizontal and an upright edge that do not meet.
const LineSegment3 kHorizontal{{0, 0, 0}, {1, 0.1, 0}};
const LineSegment3 kUpright{{0.4, 0.5, 0.2}, {0.4, 0.5, 1.0}};

// Another part of the same infinite line, with the same direction.
LineSegment3 Slid(const LineSegment3& line, double by) { return {line.At(by), line.At(by + 0.7)}; }

TEST(AlignLines, RecoversTransformFromOtherPartsOfTheLines) {
  const auto pose =
      AlignLines({kHorizontal, kUpright},
                 {Slid(kTruth * kHorizontal, 0.3), Slid(kTruth * kUpright, -0.8)}, kTolerance);
  ASSERT_TRUE(pose.has_value());
  EXPECT_LT((*pose * kTruth.Inverse()).translation().norm(), 1e-12);
  EXPECT_LT(LogSO3((*pose * kTruth.Inverse()).rotation()).norm(), 1e-12);
}

TEST(AlignLines, SharesErrorOfAngleBetweenTheLines) {
  // The upright edge leans by 2 degrees: each line ends up 1 degree off.
  LineSegment3 leaning = kUpright;
  leaning.end =
      kUpright.start + ExpSO3({0, DegreesToRadians(2.0), 0}) * (kUpright.end - kUpright.start);
  const auto pose = AlignLines({kHorizontal, kUpright}, {kHorizontal, leaning}, kTolerance);
  ASSERT_TRUE(pose.has_value());
  EXPECT_NEAR(RadiansToDegrees(LogSO3(pose->rotation()).norm()), 1.0, 0.05);
}

TEST(AlignLines, RejectsParallelLines) {
  LineSegment3 parallel = kHorizontal;
  parallel.start.z() = parallel.end.z() = 0.4;
  EXPECT_FALSE(AlignLines({kHorizontal, parallel}, {kHorizontal, parallel}, kTolerance));
}

TEST(AlignLines, RejectsOtherAngleOtherDistanceAndOppositeDirection) {
  LineSegment3 leaning = kUpright, moved = kUpright, reversed = kUpright;
  leaning.end += Vec(0.1, 0, 0);  // 7 degrees towards the horizontal edge
  moved.start.y() = moved.end.y() = 0.53;
  std::swap(reversed.start, reversed.end);
  EXPECT_FALSE(AlignLines({kHorizontal, kUpright}, {kHorizontal, leaning}, kTolerance));
  EXPECT_FALSE(AlignLines({kHorizontal, kUpright}, {kHorizontal, moved}, kTolerance));
  // At right angles, a reversed edge is seen by the sign of the distance.
  EXPECT_FALSE(AlignLines({kHorizontal, kUpright}, {kHorizontal, reversed}, kTolerance));
}

TEST(AlignLineAndPoint, RecoversTransform) {
  const Vec point(0.3, 0.9, -0.4);
  const auto pose = AlignLineAndPoint(kHorizontal, point, Slid(kTruth * kHorizontal, 0.4),
                                      kTruth * point, kTolerance);
  ASSERT_TRUE(pose.has_value());
  EXPECT_LT((*pose * kTruth.Inverse()).translation().norm(), 1e-12);
  EXPECT_LT(LogSO3((*pose * kTruth.Inverse()).rotation()).norm(), 1e-12);
}

TEST(AlignLineAndPoint, RejectsPointOnTheLineAndOtherDistance) {
  const Vec on_line = kHorizontal.At(0.5) + Vec(0, 0, 0.05), beside(0.3, 0.9, -0.4);
  EXPECT_FALSE(AlignLineAndPoint(kHorizontal, on_line, kHorizontal, on_line, kTolerance));
  EXPECT_FALSE(
      AlignLineAndPoint(kHorizontal, beside, kHorizontal, Vec(0.3, 0.93, -0.4), kTolerance));
}

}  // namespace
}  // namespace msc_vo
