// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/mapping/map_lines.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/support/synthetic_keyframes.h"
#include <gtest/gtest.h>

#include "msc_vo/geometry/angles.h"
#include "msc_vo/mapping/mapper.h"

namespace msc_vo {
namespace {

// A mapper that has seen a box whose lines follow three axes.
Mapper MapBox(const MapperOptions& options) {
  SyntheticFrames::Options noisy;
  noisy.pixel_noise = 1.0;
  SyntheticFrames world{noisy};
  std::mt19937 random(1);
  Mapper mapper(options);
  for (int index = 0; index <= 60; index += 10) {
    KeyframePacket packet = Packet(&world, index, &random);
    MatchWithMap(mapper.map(), &packet);
    mapper.Process(packet);
  }
  return mapper;
}

// Angle, radians, to the nearest axis of the box. The world of the map is the first camera.
double AxisError(const LineSegment3& line) {
  const Eigen::Vector3d in_box =
      SyntheticFrames::CamFromWorld(0).rotation().conjugate() * line.Direction();
  double error = kPi;
  for (int i = 0; i < 3; ++i) {
    error = std::min(error, UndirectedAngle(in_box, Eigen::Vector3d(Eigen::Vector3d::Unit(i))));
  }
  return error;
}

TEST(RefineMapLines, TurnsUncertainLinesToTheirAxes) {
  MapperOptions options;
  options.window.manhattan.enabled = false;  // no window turns a line
  const Mapper mapper = MapBox(options);
  ASSERT_EQ(mapper.axes().estimator().state(), AxesState::kRefined);
  options.window.manhattan.enabled = true;
  const auto refined =
      RefineMapLines(options, mapper.atlas().current(), StructuralPairs(options.pairs));
  ASSERT_GE(refined.size(), 20u);
  double before = 0.0, after = 0.0;
  size_t num_aligned = 0;
  for (const auto& [id, best] : refined) {
    const LineLandmark* line = mapper.map().Find<LineLandmark>(id);
    ASSERT_NE(line, nullptr);
    before += std::pow(AxisError(line->segment), 2);
    after += std::pow(AxisError(best.segment), 2);
    EXPECT_LT(best.segment.DistanceToLine(line->segment.Midpoint()), 0.05);
    num_aligned += best.axis ? 1 : 0;
  }
  EXPECT_GT(num_aligned, 0.8 * refined.size());
  EXPECT_LT(after, 0.5 * before);
}

TEST(RefineMapLines, ReturnsNoneWithoutAxes) {
  MapperOptions options;
  options.axes.enabled = false;
  const Mapper mapper = MapBox(options);
  EXPECT_TRUE(mapper.RefinedLines(mapper.atlas().current()).empty());
}

}  // namespace
}  // namespace msc_vo
