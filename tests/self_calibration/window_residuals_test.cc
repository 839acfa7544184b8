// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/self_calibration/window_residuals.h"

#include <stdexcept>

#include <gmock/gmock.h>

#include "msc_vo/synthetic/window/synthetic_window.h"

namespace msc_vo {
namespace {

WindowData Truth() {
  SyntheticWindowOptions options;
  options.num_points = 50;
  options.num_lines = 10;
  return MakeSyntheticWindow(options).truth;
}

TEST(WindowResiduals, AreZeroForTheTruth) {
  const WindowData truth = Truth();
  const WindowResiduals residuals(truth);
  for (size_t i = 0; i < truth.point_observations.size(); ++i) {
    EXPECT_LT(std::abs(*residuals.PointDepth(i)), 1e-9);
  }
  for (size_t i = 0; i < truth.line_observations.size(); ++i) {
    EXPECT_LT(residuals.LinePixel(i)->norm(), 1e-6);
    EXPECT_LT(std::abs(*residuals.LineDepth(i)), 1e-6);
  }
}

TEST(WindowResiduals, AreInSigmas) {
  WindowData window = Truth();
  WindowData::PointObservation& point = window.point_observations[3];
  point.inverse_depth -= 3.0 * point.inverse_depth_sigma;
  WindowData::LineObservation& line = window.line_observations[2];
  const double sigma = line.depth.SigmaAt(0.5);
  line.depth.start -= 1.5 * sigma;
  line.depth.end -= 1.5 * sigma;
  const WindowResiduals residuals(window);
  EXPECT_NEAR(*residuals.PointDepth(3), 3.0, 1e-9);
  EXPECT_NEAR(*residuals.LineDepth(2), 1.5, 1e-6);
}

TEST(WindowResiduals, CorrectTheDepthOffsetAndIgnoreTheNoise) {
  WindowData window = Truth();
  WindowData::LineObservation& o = window.line_observations[2];
  for (double* end : {&o.depth.start, &o.depth.end}) *end = 1.0 / (1.0 / *end + 0.01);
  for (WindowData::Line& line : window.lines) {
    if (line.id != o.line) continue;
    line.depth_offset = 0.01;
    line.noise = 0.1;
  }
  o.segment.start += 0.5 * o.sigma * Eigen::Vector2d::Ones();
  const double pixels = WindowResiduals(window).LinePixel(2)->norm();
  EXPECT_GT(pixels, 0.05);
  EXPECT_LT(pixels, 1.0);
  // The shifted midpoint changes the depth slightly.
  EXPECT_LT(std::abs(*WindowResiduals(window).LineDepth(2)), 0.5);
}

TEST(WindowResiduals, AreNulloptWithoutAMeasurement) {
  WindowData window = Truth();
  window.point_observations[0].inverse_depth = 0.0;
  window.line_observations[0].has_depth = false;
  const size_t last = window.point_observations.size() - 1;
  const int64_t hidden = window.point_observations[last].point;
  ASSERT_NE(hidden, window.point_observations[0].point);
  for (const WindowData::Keyframe& keyframe : window.keyframes) {
    if (keyframe.id != window.point_observations[last].keyframe) continue;
    for (WindowData::Point& point : window.points) {
      const Eigen::Vector3d behind = keyframe.cam_from_world.Inverse() * Eigen::Vector3d(0, 0, -1);
      if (point.id == hidden) point.position = behind;
    }
  }
  // A line along a viewing ray, from an observation of another line.
  const WindowData::LineObservation& along_ray = window.line_observations.back();
  ASSERT_NE(along_ray.line, window.line_observations[0].line);
  for (const WindowData::Keyframe& keyframe : window.keyframes) {
    if (keyframe.id != along_ray.keyframe) continue;
    const Rigid3 world_from_cam = keyframe.cam_from_world.Inverse();
    for (WindowData::Line& line : window.lines) {
      if (line.id != along_ray.line) continue;
      line.segment = world_from_cam * LineSegment3{{0.25, -0.125, 2.0}, {0.5, -0.25, 4.0}};
    }
  }
  const WindowResiduals residuals(window);
  EXPECT_FALSE(residuals.PointDepth(0));
  EXPECT_FALSE(residuals.LineDepth(0));
  EXPECT_FALSE(residuals.LineDepth(window.line_observations.size() - 1));
  EXPECT_TRUE(residuals.LinePixel(window.line_observations.size() - 1));
  EXPECT_TRUE(residuals.LinePixel(0));
  EXPECT_FALSE(residuals.PointDepth(last));
}

TEST(WindowResiduals, RejectUnknownLandmarks) {
  WindowData window = Truth();
  window.point_observations[0].point = 123456;
  EXPECT_THROW(WindowResiduals{window}, std::out_of_range);
}

}  // namespace
}  // namespace msc_vo
