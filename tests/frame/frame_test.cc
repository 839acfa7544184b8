// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/frame/frame.h"

#include <gtest/gtest.h>

namespace msc_vo {
namespace {

TEST(Frame, BackProjectsPointsAndLines) {
  Frame frame;
  PointFeature point;
  point.pixel = {frame.camera.cx + 105.0, frame.camera.cy};
  point.inverse_depth = 0.5;
  frame.points = {point};
  EXPECT_TRUE(frame.PointInCamera(0).isApprox(Eigen::Vector3d(0.4, 0.0, 2.0), 1e-12));

  LineFeature line;
  line.segment.start = frame.camera.Project({-1.0, 0.2, 2.0});
  line.segment.end = frame.camera.Project({1.0, 0.2, 4.0});
  LineDepth depth;
  depth.start = 0.5;
  depth.end = 0.25;
  line.depth = depth;
  frame.lines = {line};
  const LineSegment3 segment = frame.LineInCamera(0);
  EXPECT_TRUE(segment.start.isApprox(Eigen::Vector3d(-1.0, 0.2, 2.0), 1e-12));
  EXPECT_TRUE(segment.end.isApprox(Eigen::Vector3d(1.0, 0.2, 4.0), 1e-12));
}

}  // namespace
}  // namespace msc_vo
