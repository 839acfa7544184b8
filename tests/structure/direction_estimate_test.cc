// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/structure/direction_estimate.h"

#include <cmath>

#include "tests/support/synthetic_frames.h"
#include "tests/support/synthetic_map.h"
#include <gtest/gtest.h>

#include "msc_vo/geometry/angles.h"
#include "msc_vo/map/window_selection.h"

namespace msc_vo {
namespace {

// All lines of one keyframe; the world is that of the box, whose axes the lines follow.
WindowData MakeWindow(unsigned seed) {
  SyntheticFrames::Options options;
  options.seed = seed;
  // The errors that the features claim.
  options.pixel_noise = 1.0;
  options.inverse_depth_noise = 1.425e-3;
  SyntheticFrames world{options};
  const Map map = MapOfOneKeyframe(world.MakeFrame(0), SyntheticFrames::CamFromWorld(0)).map;
  WindowSelectionOptions selection;
  selection.min_observations = 1;
  return SelectWindow(selection, map, 0);
}

Eigen::Vector3d NearestAxisOfTheBox(const Eigen::Vector3d& direction) {
  int axis = 0;
  direction.cwiseAbs().maxCoeff(&axis);
  return Eigen::Vector3d::Unit(axis);
}

TEST(DirectionEstimate, IsAsAccurateAsItsCovarianceSays) {
  // Chi-square of the deviation from the true axis, two degrees of freedom per line.
  double chi_square = 0.0;
  int num_lines = 0;
  for (unsigned seed = 1; seed <= 10; ++seed) {
    for (const auto& estimate : EstimateDirections(MakeWindow(seed))) {
      ASSERT_TRUE(estimate.has_value());
      const Eigen::Vector3d axis = NearestAxisOfTheBox(estimate->direction);
      if (UndirectedAngle(axis, estimate->direction) > DegreesToRadians(20.0)) continue;
      Eigen::Matrix<double, 3, 2> across;
      across << axis.unitOrthogonal(), axis.cross(axis.unitOrthogonal());
      const Eigen::Vector2d angle = across.transpose() * estimate->direction;
      const Eigen::Matrix2d covariance = across.transpose() * estimate->covariance * across;
      chi_square += angle.dot(covariance.inverse() * angle);
      ++num_lines;
    }
  }
  ASSERT_GT(num_lines, 100);
  // Outer 99.8 % bounds of the mean of chi-square / 2 over as many lines, and 10 % for the
  // linearisation.
  const double spread = 3.1 / std::sqrt(static_cast<double>(num_lines));
  EXPECT_NEAR(chi_square / (2.0 * num_lines), 1.0, spread + 0.1);
}

TEST(DirectionEstimate, DoesNotDependOnTheDirectionOfTheMapLine) {
  WindowData window = MakeWindow(1);
  const auto before = EstimateDirections(window);
  // Turned by two degrees about its first end point, as a wrong structural term would.
  for (WindowData::Line& line : window.lines) {
    const Eigen::Vector3d axis = line.segment.Direction().unitOrthogonal();
    const Eigen::AngleAxisd turn(DegreesToRadians(2.0), axis);
    line.segment.end = line.segment.start + turn * (line.segment.end - line.segment.start);
  }
  const auto after = EstimateDirections(window);
  for (size_t i = 0; i < before.size(); ++i) {
    ASSERT_TRUE(before[i] && after[i]);
    EXPECT_LT(UndirectedAngle(before[i]->direction, after[i]->direction), DegreesToRadians(0.1));
  }
}

TEST(DirectionEstimate, IsUnknownForASingleViewWithoutDepth) {
  WindowData window = MakeWindow(1);
  for (WindowData::LineObservation& observation : window.line_observations) {
    observation.has_depth = false;
  }
  for (const auto& estimate : EstimateDirections(window)) EXPECT_FALSE(estimate.has_value());
}

TEST(DirectionEstimate, HasNoUncertaintyAlongItself) {
  for (const auto& estimate : EstimateDirections(MakeWindow(1))) {
    ASSERT_TRUE(estimate.has_value());
    EXPECT_LT((estimate->covariance * estimate->direction).norm(), 1e-12);
    EXPECT_GT(estimate->Sigma(), 0.0);
  }
}

}  // namespace
}  // namespace msc_vo
