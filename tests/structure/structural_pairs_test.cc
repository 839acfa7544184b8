// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/structure/structural_pairs.h"

#include <algorithm>
#include <map>
#include <random>
#include <vector>

#include "tests/support/synthetic_frames.h"
#include "tests/support/synthetic_map.h"
#include <gtest/gtest.h>

#include "msc_vo/geometry/angles.h"
#include "msc_vo/map/window_selection.h"
#include "msc_vo/structure/internal/relation_mixture.h"

namespace msc_vo {
namespace {

// One keyframe that observes lines along the three axes of a box.
class StructuralPairsTest : public ::testing::Test {
 protected:
  StructuralPairsTest() {
    SyntheticFrames::Options options;
    options.num_lines = 60;
    options.pixel_noise = 0.1;
    options.inverse_depth_noise = 2e-4;
    SyntheticFrames world{options};
    map_ = MapOfOneKeyframe(world.MakeFrame(0), Rigid3()).map;
    WindowSelectionOptions selection;
    selection.min_observations = 1;
    window_ = SelectWindow(selection, map_, 0);
    for (WindowData::LineObservation& observation : window_.line_observations) {
      observation.sigma = 0.1;
      observation.depth.covariance = 2e-4 * 2e-4 * Eigen::Matrix2d::Identity();
    }
  }

  double Degrees(const WindowData::LinePair& pair) const {
    return RadiansToDegrees(UndirectedAngle(map_.Find<LineLandmark>(pair.a)->segment.Direction(),
                                            map_.Find<LineLandmark>(pair.b)->segment.Direction()));
  }

  void Add() {
    StructuralPairs pairs(options_);
    LearnAndAdd(&pairs, &window_);
  }
  static void LearnAndAdd(StructuralPairs* pairs, WindowData* window) {
    const PairCandidates candidates = pairs->Find(*window);
    pairs->Learn(candidates);
    pairs->Add(candidates, window);
  }

  Map map_;
  WindowData window_;
  StructuralPairOptions options_;
};

TEST_F(StructuralPairsTest, SelectsParallelAndPerpendicularPairs) {
  Add();
  EXPECT_GT(window_.parallel_pairs.size(), window_.lines.size() / 2);
  EXPECT_GT(window_.perpendicular_pairs.size(), window_.lines.size() / 4);
  for (const auto& pair : window_.parallel_pairs) EXPECT_LT(Degrees(pair), options_.max_angle);
  for (const auto& pair : window_.perpendicular_pairs) {
    EXPECT_GT(Degrees(pair), 90.0 - options_.max_angle);
    EXPECT_EQ(pair.count, 1);
  }
}

TEST_F(StructuralPairsTest, LearnsTheDeviationOfPairs) {
  StructuralPairs pairs(options_);
  for (int i = 0; i < 3; ++i) LearnAndAdd(&pairs, &window_);
  // The lines of the box are exact, and known to some tenths of a degree.
  EXPECT_LT(RadiansToDegrees(pairs.deviation().scale()),
            RadiansToDegrees(0.5 * DeviationEstimator().scale()));
}

// Lines in random directions: about every twentieth pair is within three degrees of 90 by chance.
TEST_F(StructuralPairsTest, LeavesOutPairsByChance) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  const PinholeCamera& camera = window_.camera;
  WindowData scattered = window_;
  scattered.lines.clear();
  scattered.line_observations.clear();
  for (int i = 0; i < 150; ++i) {
    WindowData::Line line;
    line.id = i;
    const Eigen::Vector3d middle{0.5 * normal(random), 0.5 * normal(random), 3.0};
    const Eigen::Vector3d direction{normal(random), normal(random), normal(random)};
    line.segment = {middle - 0.4 * direction.normalized(), middle + 0.4 * direction.normalized()};
    WindowData::LineObservation observation;
    observation.line = line.id;
    observation.segment = {camera.Project(line.segment.start), camera.Project(line.segment.end)};
    observation.has_depth = true;
    observation.depth.start = 1.0 / line.segment.start.z();
    observation.depth.end = 1.0 / line.segment.end.z();
    observation.depth.covariance = 1e-8 * Eigen::Matrix2d::Identity();
    scattered.lines.push_back(line);
    scattered.line_observations.push_back(observation);
  }
  scattered.keyframes[0].cam_from_world = Rigid3();
  StructuralPairs scattered_pairs(options_);
  LearnAndAdd(&scattered_pairs, &scattered);
  EXPECT_LT(scattered.perpendicular_pairs.size(), scattered.lines.size() / 20);
  EXPECT_LT(scattered.parallel_pairs.size(), scattered.lines.size() / 20);
}

// The deviation of a line is common to all its pairs: together they weigh no more than it is known.
TEST_F(StructuralPairsTest, WeighsALineWithManyPartnersOnce) {
  options_.perpendicular = false;
  // A line that is known far better than all others is among the best partners of each.
  const int64_t best_line = window_.line_observations.front().line;
  for (WindowData::LineObservation& observation : window_.line_observations) {
    if (observation.line == best_line) observation.depth.covariance *= 1e-4;
  }
  StructuralPairs pairs(options_);
  LearnAndAdd(&pairs, &window_);
  std::map<int64_t, double> information;
  std::map<int64_t, int> num_partners;
  for (const auto& pair : window_.parallel_pairs) {
    for (const int64_t line : {pair.a, pair.b}) {
      information[line] += 1.0 / (pair.sigma * pair.sigma);
      ++num_partners[line];
    }
  }
  // Two, as Student's distribution is narrower than its scale, times at most four for the partners.
  const double limit = 8.0 / (pairs.deviation().scale() * pairs.deviation().scale());
  int most_partners = 0;
  for (const auto& [line, sum] : information) {
    EXPECT_LT(sum, limit);
    most_partners = std::max(most_partners, num_partners[line]);
  }
  EXPECT_GE(most_partners, 15);
}

TEST_F(StructuralPairsTest, ExcludesLinesWithoutACommonKeyframe) {
  window_.line_observations.resize(1);
  Add();
  EXPECT_TRUE(window_.parallel_pairs.empty());
  EXPECT_TRUE(window_.perpendicular_pairs.empty());
}

TEST_F(StructuralPairsTest, ExcludesPairsOfAlignedLines) {
  for (const WindowData::Line& line : window_.lines) {
    window_.axis_alignments.push_back({line.id, line.segment.Direction(), 0.01, false});
  }
  window_.axis_alignments.erase(window_.axis_alignments.begin());
  const int64_t free_line = window_.lines.front().id;
  // Candidates, because few of them do not show that they are related.
  const PairCandidates candidates = StructuralPairs(options_).Find(window_);
  EXPECT_FALSE(candidates.perpendicular.empty());
  for (const auto& pair : candidates.perpendicular) {
    EXPECT_TRUE(candidates.lines[pair.i] == free_line || candidates.lines[pair.j] == free_line);
  }
}

TEST_F(StructuralPairsTest, CanDisableParallelPairs) {
  options_.parallel = false;
  Add();
  EXPECT_TRUE(window_.parallel_pairs.empty());
  EXPECT_FALSE(window_.perpendicular_pairs.empty());
}

TEST_F(StructuralPairsTest, CanDisablePerpendicularPairs) {
  options_.perpendicular = false;
  Add();
  EXPECT_FALSE(window_.parallel_pairs.empty());
  EXPECT_TRUE(window_.perpendicular_pairs.empty());
}

TEST(RelationProbabilities, EstimatesTheFractionOfRelatedPairs) {
  // Seventy related pairs among a hundred, ten times as likely as by chance at their angles.
  std::vector<double> densities(70, 10.0);
  densities.resize(100, 0.1);
  const std::vector<double> probabilities = RelationProbabilities(densities, 1.0);
  EXPECT_GT(probabilities.front(), 0.95);
  EXPECT_LT(probabilities.back(), 0.3);
  // The same angles among many that fit no relation.
  densities.resize(10000, 0.1);
  EXPECT_LT(RelationProbabilities(densities, 1.0).front(), 0.2);
}

}  // namespace
}  // namespace msc_vo
