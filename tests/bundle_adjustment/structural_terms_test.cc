// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Structural terms of local bundle adjustment.

#include <stdexcept>
#include <string>

#include "tests/support/factor_checks.h"
#include "tests/support/message_matchers.h"
#include "tests/support/test_window.h"
#include <gmock/gmock.h>

#include "msc_vo/bundle_adjustment/internal/window_terms.h"
#include "msc_vo/bundle_adjustment/local_bundle_adjustment.h"
#include "msc_vo/bundle_adjustment/window_problem.h"
#include "msc_vo/geometry/angles.h"

namespace msc_vo {
namespace {

double RmsDirection(const WindowData& truth, const WindowData& solved) {
  double sum = 0.0;
  for (size_t i = 0; i < truth.lines.size(); ++i) {
    sum += std::pow(
        UndirectedAngle(truth.lines[i].segment.Direction(), solved.lines[i].segment.Direction()),
        2);
  }
  return RadiansToDegrees(std::sqrt(sum / double(truth.lines.size())));
}

// Structural terms between lines of the test window, of which line i is parallel to axis i % 3.
class StructuralTermsTest : public ::testing::Test {
 protected:
  StructuralTermsTest() {
    scene_.inverse_depth_sigma = 0.02;  // noisy depth
    options_.second_iterations = 30;
  }
  void Make() {
    window_ = MakeTestWindow(scene_);
    data_ = window_.data;
  }
  WindowData::LinePair Pair(int i, int j, int count = 1) const {
    WindowData::LinePair pair;
    pair.a = data_.lines[i].id;
    pair.b = data_.lines[j].id;
    pair.sigma = 0.01;
    pair.count = count;
    return pair;
  }
  void AddPair(int i, int j, int count = 1) {
    (i % 3 == j % 3 ? data_.parallel_pairs : data_.perpendicular_pairs)
        .push_back(Pair(i, j, count));
  }
  // Pairs every line with the next `count` lines.
  void AddTruePairs(int count) {
    const int n = static_cast<int>(data_.lines.size());
    for (int i = 0; i < n; ++i) {
      for (int k = 1; k <= count && i + k < n; ++k) AddPair(i, i + k);
    }
  }
  void AddAlignments() {
    for (size_t i = 0; i < data_.lines.size(); ++i) {
      WindowData::AxisAlignment alignment;
      alignment.line = data_.lines[i].id;
      alignment.axis = (i % 2 == 0 ? 1.0 : -1.0) * Eigen::Vector3d::Unit(i % 3);
      alignment.sigma = 0.01;
      data_.axis_alignments.push_back(alignment);
    }
  }

  TestWindowOptions scene_;
  BundleAdjustmentOptions options_;
  TestWindow window_;
  WindowData data_;
};

TEST_F(StructuralTermsTest, PairsHalveDirectionErrors) {
  Make();
  WindowData without = data_;
  ASSERT_TRUE(LocalBundleAdjustment(options_, &without).usable);
  AddTruePairs(8);
  const BundleAdjustmentSummary summary = LocalBundleAdjustment(options_, &data_);
  ASSERT_TRUE(summary.usable) << summary.BriefReport();
  const double before = RmsDirection(window_.truth, without);
  const double after = RmsDirection(window_.truth, data_);
  RecordProperty("without", std::to_string(before));
  RecordProperty("with", std::to_string(after));
  EXPECT_GT(before, 0.5);
  EXPECT_LT(after, 0.5 * before);
  EXPECT_LE(summary.parallel.num_rejected + summary.perpendicular.num_rejected, 6);
  EXPECT_EQ(summary.parallel.num_residual_blocks + summary.parallel.num_rejected,
            static_cast<int>(data_.parallel_pairs.size()));
}

TEST_F(StructuralTermsTest, AlignmentsHalveDirectionErrors) {
  Make();
  WindowData without = data_;
  ASSERT_TRUE(LocalBundleAdjustment(options_, &without).usable);
  AddAlignments();
  const BundleAdjustmentSummary summary = LocalBundleAdjustment(options_, &data_);
  ASSERT_TRUE(summary.usable);
  EXPECT_LT(RmsDirection(window_.truth, data_), 0.5 * RmsDirection(window_.truth, without));
  EXPECT_EQ(summary.manhattan.num_residual_blocks + summary.manhattan.num_rejected, 40);
  EXPECT_GT(summary.manhattan.final_cost, 0.0);
}

TEST_F(StructuralTermsTest, RecoversTheTruthFromExactStructure) {
  scene_.noise = 0.0;
  Make();
  AddTruePairs(4);
  AddAlignments();
  const BundleAdjustmentSummary summary = LocalBundleAdjustment(options_, &data_);
  ASSERT_TRUE(summary.usable);
  EXPECT_EQ(summary.parallel.num_rejected, 0);
  EXPECT_EQ(summary.perpendicular.num_rejected, 0);
  EXPECT_EQ(summary.manhattan.num_rejected, 0);
  EXPECT_LT(RmsDirection(window_.truth, data_), 1e-3);
  EXPECT_LT(summary.final_cost, 1e-3);
}

TEST_F(StructuralTermsTest, RejectsWrongPairsAndAlignments) {
  scene_.inverse_depth_sigma = 0.002;
  Make();
  AddTruePairs(6);
  AddAlignments();
  const size_t parallel = data_.parallel_pairs.size();
  const size_t perpendicular = data_.perpendicular_pairs.size();
  data_.parallel_pairs.push_back(Pair(3, 7));       // perpendicular
  data_.perpendicular_pairs.push_back(Pair(3, 9));  // parallel
  data_.axis_alignments.push_back(data_.axis_alignments[5]);
  data_.axis_alignments.back().axis = Eigen::Vector3d(0.0, std::sin(0.1), std::cos(0.1));
  const BundleAdjustmentSummary summary = LocalBundleAdjustment(options_, &data_);
  ASSERT_TRUE(summary.usable);
  EXPECT_TRUE(data_.parallel_pairs[parallel].rejected);
  EXPECT_TRUE(data_.perpendicular_pairs[perpendicular].rejected);
  EXPECT_TRUE(data_.axis_alignments[40].rejected);
  int rejected = 0;
  for (const auto& p : data_.parallel_pairs) rejected += p.rejected;
  EXPECT_EQ(rejected, summary.parallel.num_rejected);
  EXPECT_LE(rejected, 1 + static_cast<int>(parallel) / 20);
  rejected = 0;
  for (const auto& a : data_.axis_alignments) rejected += a.rejected;
  EXPECT_EQ(rejected, summary.manhattan.num_rejected);
  EXPECT_LE(rejected, 1 + 2);
  EXPECT_LT(RmsDirection(window_.truth, data_), 0.5);
}

TEST_F(StructuralTermsTest, IgnoresEarlierRejectionMarks) {
  scene_.noise = 0.0;
  Make();
  AddTruePairs(2);
  AddAlignments();
  for (auto& p : data_.parallel_pairs) p.rejected = true;
  for (auto& a : data_.axis_alignments) a.rejected = true;
  const BundleAdjustmentSummary summary = LocalBundleAdjustment(options_, &data_);
  ASSERT_TRUE(summary.usable);
  EXPECT_EQ(summary.parallel.num_residual_blocks, static_cast<int>(data_.parallel_pairs.size()));
  for (const auto& p : data_.parallel_pairs) EXPECT_FALSE(p.rejected);
  for (const auto& a : data_.axis_alignments) EXPECT_FALSE(a.rejected);
}

TEST_F(StructuralTermsTest, DisabledTermsChangeNothing) {
  Make();
  WindowData without = data_;
  const BundleAdjustmentSummary plain = LocalBundleAdjustment(options_, &without);
  AddTruePairs(4);
  AddAlignments();
  options_.parallel.enabled = options_.perpendicular.enabled = options_.manhattan.enabled = false;
  const BundleAdjustmentSummary off = LocalBundleAdjustment(options_, &data_);
  ASSERT_TRUE(plain.usable && off.usable);
  EXPECT_TRUE(SameState(without, data_));
  EXPECT_EQ(plain.final_cost, off.final_cost);
  EXPECT_EQ(plain.num_iterations, off.num_iterations);
  EXPECT_EQ(off.parallel.num_residual_blocks + off.perpendicular.num_residual_blocks +
                off.manhattan.num_residual_blocks,
            0);
  EXPECT_EQ(off.parallel.final_cost, 0.0);
}

TEST_F(StructuralTermsTest, EachTermHasItsOwnOptionAndCost) {
  Make();
  AddTruePairs(4);
  AddAlignments();
  const auto blocks = [&](bool parallel, bool perpendicular, bool manhattan) {
    BundleAdjustmentOptions options = options_;
    options.parallel.enabled = parallel;
    options.perpendicular.enabled = perpendicular;
    options.manhattan.enabled = manhattan;
    WindowData data = data_;
    const BundleAdjustmentSummary s = LocalBundleAdjustment(options, &data);
    EXPECT_DOUBLE_EQ(s.final_cost, s.point_reprojection.final_cost + s.point_depth.final_cost +
                                       s.line_reprojection.final_cost + s.line_depth.final_cost +
                                       s.line_endpoint_prior.final_cost + s.parallel.final_cost +
                                       s.perpendicular.final_cost + s.manhattan.final_cost);
    EXPECT_EQ(s.parallel.initial_cost > 0.0, parallel);
    EXPECT_EQ(s.perpendicular.initial_cost > 0.0, perpendicular);
    EXPECT_EQ(s.manhattan.initial_cost > 0.0, manhattan);
  };
  blocks(true, false, false);
  blocks(false, true, false);
  blocks(false, false, true);
  blocks(true, true, true);
}

TEST_F(StructuralTermsTest, EndpointPriorCanBeDisabled) {
  Make();
  options_.line_endpoint_prior = false;
  const BundleAdjustmentSummary summary = LocalBundleAdjustment(options_, &data_);
  ASSERT_TRUE(summary.usable) << summary.BriefReport();
  EXPECT_EQ(summary.line_endpoint_prior.num_residual_blocks, 0);
  EXPECT_EQ(summary.line_endpoint_prior.final_cost, 0.0);
}

TEST_F(StructuralTermsTest, CountEqualsRepeatedPairs) {
  Make();
  WindowData many = data_;
  for (int i = 0; i + 1 < 40; ++i) {
    AddPair(i, i + 1, 3);
    auto& pairs = i % 3 == (i + 1) % 3 ? many.parallel_pairs : many.perpendicular_pairs;
    pairs.insert(pairs.end(), 3, Pair(i, i + 1));
  }
  const BundleAdjustmentSummary counted = LocalBundleAdjustment(options_, &data_);
  const BundleAdjustmentSummary repeated = LocalBundleAdjustment(options_, &many);
  ASSERT_TRUE(counted.usable && repeated.usable);
  EXPECT_NEAR(counted.perpendicular.initial_cost, repeated.perpendicular.initial_cost,
              1e-9 * repeated.perpendicular.initial_cost);
  EXPECT_NEAR(counted.final_cost, repeated.final_cost, 1e-6 * repeated.final_cost);
  EXPECT_EQ(3 * counted.perpendicular.num_residual_blocks,
            repeated.perpendicular.num_residual_blocks);
  for (size_t i = 0; i < data_.lines.size(); ++i) {
    EXPECT_THAT(data_.lines[i].segment.end, IsNear(many.lines[i].segment.end, 1e-5));
  }
}

TEST_F(StructuralTermsTest, IgnoresTermsOfUnobservedLines) {
  scene_.noise = 0.0;
  Make();
  AddTruePairs(3);
  AddAlignments();
  auto& observations = data_.line_observations;
  const int64_t unobserved = data_.lines[4].id;
  observations.erase(
      std::remove_if(observations.begin(), observations.end(),
                     [&](const WindowData::LineObservation& o) { return o.line == unobserved; }),
      observations.end());
  const LineSegment3 before = data_.lines[4].segment;
  const BundleAdjustmentSummary summary = LocalBundleAdjustment(options_, &data_);
  ASSERT_TRUE(summary.usable);
  EXPECT_EQ(data_.lines[4].segment.start, before.start);
  EXPECT_EQ(data_.lines[4].segment.end, before.end);
  EXPECT_EQ(summary.manhattan.num_residual_blocks, 39);
  EXPECT_EQ(summary.manhattan.num_rejected, 0);
  EXPECT_FALSE(data_.axis_alignments[4].rejected);
}

TEST_F(StructuralTermsTest, FixedLinesConstrainFreeLines) {
  Make();
  for (int i : {0, 1, 2}) data_.lines[i] = window_.truth.lines[i];
  for (int i : {0, 1, 2}) data_.lines[i].fixed = true;
  const WindowData before = data_;
  for (int i = 3; i < 40; ++i) {
    for (int j : {0, 1, 2}) AddPair(j, i);
  }
  AddPair(0, 1);  // two fixed lines: no residual block
  WindowData without = before;
  ASSERT_TRUE(LocalBundleAdjustment(options_, &without).usable);
  const BundleAdjustmentSummary summary = LocalBundleAdjustment(options_, &data_);
  ASSERT_TRUE(summary.usable);
  EXPECT_EQ(summary.perpendicular.num_residual_blocks + summary.perpendicular.num_rejected, 74);
  for (int i : {0, 1, 2}) EXPECT_EQ(data_.lines[i].segment.end, before.lines[i].segment.end);
  EXPECT_LT(RmsDirection(window_.truth, data_), 0.5 * RmsDirection(window_.truth, without));
}

TEST_F(StructuralTermsTest, FixedLinesNeedNoObservation) {
  Make();
  const auto add_known_line = [this](int64_t id, int axis) {
    data_.lines.push_back({id, {{0.0, 0.0, 2.0}, Eigen::Vector3d::Unit(axis)}, true});
    data_.lines.back().segment.end += data_.lines.back().segment.start;
  };
  WindowData without = data_;
  ASSERT_TRUE(LocalBundleAdjustment(options_, &without).usable);
  const int num_lines = static_cast<int>(data_.lines.size());
  for (int axis : {0, 1, 2}) add_known_line(9000 + axis, axis);
  for (int i = 0; i < num_lines; ++i) {
    data_.parallel_pairs.push_back(Pair(num_lines + i % 3, i));
    data_.perpendicular_pairs.push_back(Pair(num_lines + (i + 1) % 3, i));
  }
  data_.parallel_pairs.push_back(Pair(num_lines, num_lines + 1));  // no free line
  for (const auto solver : {BundleAdjustmentSolver::kBlockSchur, BundleAdjustmentSolver::kCeres}) {
    options_.solver = solver;
    WindowData with = data_;
    const BundleAdjustmentSummary summary = LocalBundleAdjustment(options_, &with);
    ASSERT_TRUE(summary.usable);
    EXPECT_EQ(summary.parallel.num_residual_blocks + summary.parallel.num_rejected, num_lines);
    EXPECT_EQ(summary.perpendicular.num_residual_blocks + summary.perpendicular.num_rejected,
              num_lines);
    EXPECT_EQ(with.lines[num_lines].segment.end, data_.lines[num_lines].segment.end);
    with.lines.resize(num_lines);
    EXPECT_LT(RmsDirection(window_.truth, with), 0.5 * RmsDirection(window_.truth, without));
  }
}

TEST_F(StructuralTermsTest, IsDeterministic) {
  Make();
  AddTruePairs(6);
  AddAlignments();
  WindowData other = data_;
  ASSERT_TRUE(LocalBundleAdjustment(options_, &data_).usable);
  ASSERT_TRUE(LocalBundleAdjustment(options_, &other).usable);
  EXPECT_TRUE(SameState(data_, other));
}

TEST_F(StructuralTermsTest, CeresOrderingEliminatesNoTwoPairedLines) {
  Make();
  // A star, a chain, and lines without pairs.
  for (int i = 1; i < 10; ++i) AddPair(0, i);
  for (int i = 10; i < 14; ++i) AddPair(i, i + 1);
  AddAlignments();
  const WindowIndex index = ValidateWindow(options_, data_);
  WindowInlierMask inlier_mask;
  inlier_mask.points.assign(data_.point_observations.size(), {true, true});
  inlier_mask.lines.assign(data_.line_observations.size(), {true, true});
  inlier_mask.parallel.assign(data_.parallel_pairs.size(), true);
  inlier_mask.perpendicular.assign(data_.perpendicular_pairs.size(), true);
  inlier_mask.alignments.assign(data_.axis_alignments.size(), true);
  WindowState state(data_);
  const WindowTerms terms = MakeWindowTerms(options_, data_, index, inlier_mask, state);
  const auto ordering = WindowProblem(options_, data_, terms, &state).EliminationOrdering();
  const auto group = [&](int line) { return ordering->GroupId(state.LineBlock(line)); };
  EXPECT_EQ(group(0), 1);
  for (int i = 1; i < 10; ++i) EXPECT_EQ(group(i), 0) << i;
  for (int i = 10; i < 14; ++i) EXPECT_EQ(group(i) + group(i + 1), 1) << i;
  for (int i = 15; i < 40; ++i) EXPECT_EQ(group(i), 0) << i;
  EXPECT_EQ(terms.Of<ParallelLines>().blocks.size(), 3u);
  EXPECT_EQ(terms.Of<PerpendicularLines>().blocks.size(), 10u);
  EXPECT_EQ(terms.Of<ManhattanAxisAlignment>().blocks.size(), 40u);
}

TEST_F(StructuralTermsTest, InvalidInputThrowsAndNamesTheItem) {
  Make();
  AddTruePairs(3);
  AddAlignments();
  const WindowData good = data_;
  const auto message = [&](const auto& spoil) -> std::string {
    data_ = good;
    spoil(&data_);
    try {
      LocalBundleAdjustment(options_, &data_);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "nothing was thrown";
  };
  using Data = WindowData;
  EXPECT_THAT(message([](Data* d) { d->parallel_pairs[0].b = 7777; }),
              Names("line 7777", "parallel pair", "window"));
  EXPECT_THAT(message([](Data* d) { d->perpendicular_pairs[0].a = -3; }),
              Names("line -3", "perpendicular pair", "window"));
  EXPECT_THAT(message([](Data* d) { d->parallel_pairs[0].b = d->parallel_pairs[0].a; }),
              Names("parallel pair", "line 50", "itself"));
  EXPECT_THAT(message([](Data* d) { d->perpendicular_pairs[0].sigma = 0.0; }),
              Names("perpendicular pair", "line 50", "line 52", "sigma"));
  EXPECT_THAT(message([](Data* d) { d->perpendicular_pairs[0].count = 0; }),
              Names("perpendicular pair", "line 50", "line 52", "count"));
  EXPECT_THAT(message([](Data* d) { d->axis_alignments[2].axis *= 2.0; }),
              Names("line 54", "axis", "unit"));
  EXPECT_THAT(message([](Data* d) { d->axis_alignments[2].sigma = -1.0; }),
              Names("line 54", "sigma"));
  EXPECT_THAT(message([](Data* d) { d->axis_alignments[2].line = 5; }),
              Names("line 5", "axis", "window"));
  EXPECT_TRUE(SameState(data_, good));
  data_ = good;
  options_.manhattan.huber = 0.0;
  EXPECT_THAT(message([](Data*) {}), Names("huber"));
  options_.manhattan.huber = 2.0;
  options_.reject_chi2_1 = 0.0;
  EXPECT_THAT(message([](Data*) {}), Names("reject_chi2_1"));
}

}  // namespace
}  // namespace msc_vo
