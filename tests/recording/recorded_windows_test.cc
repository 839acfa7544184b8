// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// All solvers have the same solution on windows that the mapper met (tests/data/windows).

#include <algorithm>

#include "tests/support/ceres_covariance.h"
#include "tests/support/factor_checks.h"
#include <gmock/gmock.h>

#include "msc_vo/bundle_adjustment/internal/ceres_backend.h"
#include "msc_vo/recording/window_file.h"

namespace msc_vo {
namespace {

// Bounds from rounding. The normal equations of a window have condition numbers of up to 1e8, so
// that a step has a relative error of 1e-8 in its least determined direction, the position of an
// end point along its line or the depth of a far point; steps are centimetres there at most. Poses
// are determined ten times better. The sum of costs is quadratic around its minimum and hardly
// changes; the costs of single terms change in opposite directions, to first order.
constexpr double kCostTolerance = 1e-10;     // relative to the sum
constexpr double kPoseTolerance = 1e-9;      // radians, metres
constexpr double kLandmarkTolerance = 1e-8;  // metres
constexpr double kNoiseTolerance = 1e-8;     // of noise factors; metres of depth offsets

constexpr BundleAdjustmentSolver kCeresSolvers[] = {BundleAdjustmentSolver::kCeres,
                                                    BundleAdjustmentSolver::kCeresSuiteSparse};

struct Solution {
  BundleAdjustmentSummary summary;
  WindowData data;
};

Solution Solve(const BundleAdjustmentOptions& options, const WindowData& start,
               BundleAdjustmentSolver solver) {
  BundleAdjustmentOptions with_solver = options;
  with_solver.solver = solver;
  Solution solution;
  solution.data = start;
  solution.summary = LocalBundleAdjustment(with_solver, &solution.data);
  EXPECT_TRUE(solution.summary.usable) << solution.summary.BriefReport();
  return solution;
}

void ExpectSameSummary(const BundleAdjustmentSummary& a, const BundleAdjustmentSummary& b) {
  EXPECT_EQ(a.num_behind_camera, b.num_behind_camera);
  const auto terms_a = a.Terms(), terms_b = b.Terms();
  for (size_t i = 0; i < terms_a.size(); ++i) {
    const auto& [name, s] = terms_a[i];
    const TermSummary* t = terms_b[i].second;
    EXPECT_EQ(s->num_residual_blocks, t->num_residual_blocks) << name;
    EXPECT_EQ(s->num_rejected, t->num_rejected) << name;
    EXPECT_NEAR(s->initial_cost, t->initial_cost, kCostTolerance * a.initial_cost) << name;
    EXPECT_NEAR(s->final_cost, t->final_cost, kCostTolerance * a.final_cost) << name;
  }
}

template <typename Items>
std::vector<bool> Rejected(const Items& items) {
  std::vector<bool> rejected;
  for (const auto& item : items) rejected.push_back(item.rejected);
  return rejected;
}

void ExpectSameData(const WindowData& a, const WindowData& b) {
  EXPECT_EQ(Rejected(a.point_observations), Rejected(b.point_observations));
  EXPECT_EQ(Rejected(a.line_observations), Rejected(b.line_observations));
  EXPECT_EQ(Rejected(a.parallel_pairs), Rejected(b.parallel_pairs));
  EXPECT_EQ(Rejected(a.perpendicular_pairs), Rejected(b.perpendicular_pairs));
  EXPECT_EQ(Rejected(a.axis_alignments), Rejected(b.axis_alignments));
  for (size_t i = 0; i < a.keyframes.size(); ++i) {
    EXPECT_LT(Distance(a.keyframes[i].cam_from_world, b.keyframes[i].cam_from_world),
              kPoseTolerance);
  }
  for (size_t i = 0; i < a.points.size(); ++i) {
    EXPECT_THAT(a.points[i].position, IsNear(b.points[i].position, kLandmarkTolerance));
    EXPECT_NEAR(a.points[i].noise, b.points[i].noise, kNoiseTolerance);
  }
  for (size_t i = 0; i < a.lines.size(); ++i) {
    EXPECT_THAT(a.lines[i].segment.start, IsNear(b.lines[i].segment.start, kLandmarkTolerance));
    EXPECT_THAT(a.lines[i].segment.end, IsNear(b.lines[i].segment.end, kLandmarkTolerance));
    EXPECT_NEAR(a.lines[i].noise, b.lines[i].noise, kNoiseTolerance);
    EXPECT_NEAR(a.lines[i].depth_offset, b.lines[i].depth_offset, kNoiseTolerance);
  }
}

class RecordedWindowsTest : public ::testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    window_ = ReadWindow(std::string(MSC_VO_WINDOWS_FOLDER) + "/" + GetParam() + ".txt");
    ASSERT_TRUE(window_.options.landmark_noise.enabled);
  }
  // Returns the solution of block Schur.
  Solution ExpectSameSolutions() {
    const Solution expected =
        Solve(window_.options, window_.data, BundleAdjustmentSolver::kBlockSchur);
    for (const BundleAdjustmentSolver solver : kCeresSolvers) {
      if (!IsAvailable(solver)) continue;
      SCOPED_TRACE(static_cast<int>(solver));
      const Solution found = Solve(window_.options, window_.data, solver);
      ExpectSameSummary(found.summary, expected.summary);
      ExpectSameData(found.data, expected.data);
    }
    return expected;
  }

  RecordedWindow window_;
};

TEST_P(RecordedWindowsTest, HaveTheSameSolutionWithTheStepsOfTheMapper) {
  EXPECT_EQ(window_.options.first_iterations, 2);
  EXPECT_EQ(window_.options.second_iterations, 1);
  const Solution solution = ExpectSameSolutions();
  EXPECT_LT(solution.summary.final_cost, 0.9 * solution.summary.initial_cost);
  const auto is_noisy = [](const auto& landmark) { return landmark.noise > 1.5; };
  EXPECT_GT(std::count_if(solution.data.points.begin(), solution.data.points.end(), is_noisy), 0);
}

TEST_P(RecordedWindowsTest, HaveTheSameSolutionAfterManySteps) {
  window_.options.first_iterations = 5;
  window_.options.second_iterations = 10;
  ExpectSameSolutions();
}

// Line end points that are hardly held along their lines: steps are rejected in the corridor.
TEST_P(RecordedWindowsTest, HaveTheSameSolutionWithLooseEndpoints) {
  window_.options.first_iterations = 5;
  window_.options.second_iterations = 10;
  window_.options.line_endpoint_prior_sigma = 0.3;
  const Solution solution = ExpectSameSolutions();
  if (std::string(GetParam()) == "corridor") {
    EXPECT_LT(solution.summary.num_accepted, solution.summary.num_iterations);
  }
}

TEST_P(RecordedWindowsTest, HaveTheSameCovariances) {
  // No observation loses only its depth: CeresCovariance would include that.
  window_.options.reject_chi2_3 = window_.options.reject_chi2_4 = 1e9;
  for (const BundleAdjustmentSolver solver :
       {BundleAdjustmentSolver::kBlockSchur, BundleAdjustmentSolver::kCeres}) {
    const WindowData solved = Solve(window_.options, window_.data, solver).data;
    const WindowCovariance found = EstimateCovariance(window_.options, solved, AllItems(solved));
    const CeresCovariance expected(window_.options, solved);
    int num_compared = 0;
    const auto compare = [&](const auto& covariance, const double* block) {
      using Matrix = typename std::decay_t<decltype(covariance)>::value_type;
      if (!expected.Contains(block)) return;
      const Matrix matrix = expected.Of<Matrix::RowsAtCompileTime>(block);
      if (matrix.isZero(0.0)) return;  // fixed
      ExpectSameCovariance(covariance, matrix);
      ++num_compared;
    };
    const WindowState& state = expected.state_;
    for (size_t i = 0; i < solved.keyframes.size(); ++i) {
      compare(found.keyframes[i], state.PoseBlock(i));
    }
    for (size_t i = 0; i < solved.points.size(); ++i) {
      compare(found.points[i], state.PointBlock(i));
    }
    for (size_t i = 0; i < solved.lines.size(); ++i) compare(found.lines[i], state.LineBlock(i));
    EXPECT_GT(num_compared, 100);
  }
}

INSTANTIATE_TEST_SUITE_P(Windows, RecordedWindowsTest,
                         ::testing::Values("room", "corridor", "house"),
                         [](const auto& file) { return std::string(file.param); });

}  // namespace
}  // namespace msc_vo
