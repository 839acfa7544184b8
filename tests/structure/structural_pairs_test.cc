// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/structure/structural_pairs.h"

#include <map>

#include "tests/support/synthetic_frames.h"
#include "tests/support/synthetic_map.h"
#include <gmock/gmock.h>

#include "msc_vo/geometry/angles.h"
#include "msc_vo/map/window_selection.h"

namespace msc_vo {
namespace {

// One keyframe that observes lines along the three axes of a box.
class StructuralPairsTest : public ::testing::Test {
 protected:
  StructuralPairsTest() {
    SyntheticFrames world{SyntheticFrames::Options()};
    map_ = MapOfOneKeyframe(world.MakeFrame(0), Rigid3()).map;
    WindowSelectionOptions selection;
    selection.min_observations = 1;
    window_ = SelectWindow(selection, map_, 0);
  }

  double Degrees(const WindowData::LinePair& pair) const {
    return RadiansToDegrees(UndirectedAngle(map_.FindLine(pair.a)->segment.Direction(),
                                            map_.FindLine(pair.b)->segment.Direction()));
  }

  Map map_;
  WindowData window_;
  StructuralPairOptions options_;
};

TEST_F(StructuralPairsTest, SelectsParallelAndPerpendicularPairs) {
  AddStructuralPairs(options_, map_, &window_);
  EXPECT_GT(window_.parallel_pairs.size(), window_.lines.size() / 2);
  EXPECT_GT(window_.perpendicular_pairs.size(), window_.lines.size() / 2);
  for (const auto& pair : window_.parallel_pairs) EXPECT_LT(Degrees(pair), options_.max_angle);
  for (const auto& pair : window_.perpendicular_pairs) {
    EXPECT_GT(Degrees(pair), 90.0 - options_.max_angle);
    EXPECT_EQ(pair.count, 1);
    EXPECT_NEAR(pair.sigma, DegreesToRadians(options_.pair_sigma), 1e-15);
  }
}

TEST_F(StructuralPairsTest, PrefersPartnersWithTheMostCertainAngle) {
  options_.max_partners = 1;
  AddStructuralPairs(options_, map_, &window_);
  EXPECT_FALSE(window_.parallel_pairs.empty());
  EXPECT_LE(window_.parallel_pairs.size(), window_.lines.size());
  WindowData all = window_;
  options_.max_partners = 1000;
  AddStructuralPairs(options_, map_, &all);
  EXPECT_GT(all.parallel_pairs.size(), window_.parallel_pairs.size());
  const auto sigma = [&](const WindowData::LinePair& pair) {
    return std::hypot(map_.FindLine(pair.a)->direction_sigma,
                      map_.FindLine(pair.b)->direction_sigma);
  };
  std::map<int64_t, double> best;  // smallest sigma of the pairs of each line
  for (const auto& pair : all.parallel_pairs) {
    for (const int64_t line : {pair.a, pair.b}) {
      const auto found = best.emplace(line, sigma(pair)).first;
      found->second = std::min(found->second, sigma(pair));
    }
  }
  for (const auto& pair : window_.parallel_pairs) {
    EXPECT_TRUE(sigma(pair) == best.at(pair.a) || sigma(pair) == best.at(pair.b));
  }
}

TEST_F(StructuralPairsTest, ExcludesLinesWithoutACommonKeyframe) {
  window_.line_observations.resize(1);
  AddStructuralPairs(options_, map_, &window_);
  EXPECT_TRUE(window_.parallel_pairs.empty());
  EXPECT_TRUE(window_.perpendicular_pairs.empty());
}

TEST_F(StructuralPairsTest, ExcludesPairsOfAlignedLines) {
  for (const WindowData::Line& line : window_.lines) {
    window_.axis_alignments.push_back({line.id, line.segment.Direction(), 0.01, false});
  }
  window_.axis_alignments.pop_back();
  const int64_t free_line = window_.lines.back().id;
  AddStructuralPairs(options_, map_, &window_);
  EXPECT_FALSE(window_.perpendicular_pairs.empty());
  for (const auto& pair : window_.perpendicular_pairs) {
    EXPECT_TRUE(pair.a == free_line || pair.b == free_line);
  }
}

TEST_F(StructuralPairsTest, CanDisableEachKind) {
  options_.parallel = false;
  AddStructuralPairs(options_, map_, &window_);
  EXPECT_TRUE(window_.parallel_pairs.empty());
  EXPECT_FALSE(window_.perpendicular_pairs.empty());
}

TEST(StructuralPairOptions, ChecksItsOptions) {
  std::string error;
  StructuralPairOptions options;
  EXPECT_TRUE(options.IsValid(&error));
  options.pair_sigma = 0.0;
  EXPECT_FALSE(options.IsValid(&error));
  EXPECT_THAT(error, ::testing::HasSubstr("pair_sigma"));
}

}  // namespace
}  // namespace msc_vo
