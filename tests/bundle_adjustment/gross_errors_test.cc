// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Outliers that landmarks of few views can follow, and landmarks that no view determines.

#include <algorithm>
#include <cmath>

#include "tests/support/message_matchers.h"
#include "tests/support/test_window.h"
#include <gmock/gmock.h>

#include "msc_vo/bundle_adjustment/internal/ceres_backend.h"
#include "msc_vo/bundle_adjustment/observation.h"
#include "msc_vo/bundle_adjustment/window_covariance.h"
#include "msc_vo/factors/rigid3_manifold.h"

namespace msc_vo {
namespace {

template <typename Item>
const Item& Find(const std::vector<Item>& items, int64_t id) {
  return *std::find_if(items.begin(), items.end(), [id](const Item& i) { return i.id == id; });
}

struct Content {
  const char* name;
  int num_points, num_lines;
};
constexpr Content kPoints{"points", 40, 0}, kMixed{"mixed", 40, 12}, kLines{"lines", 0, 12};
void PrintTo(const Content& content, std::ostream* stream) { *stream << content.name; }

// Five views without depth from a straight path, half of the lines along it, line ends that are
// accurate to half a pixel, and errors of 20 pixels.
TestWindowOptions Scene(const Content& content, double gross_error_ratio, unsigned seed) {
  TestWindowOptions scene;
  scene.num_keyframes = 5;
  scene.num_points = content.num_points;
  scene.num_lines = content.num_lines;
  scene.has_depth = false;
  scene.line_sigma = 0.5;
  scene.lines_along_motion = true;
  scene.gross_error_ratio = gross_error_ratio;
  scene.seed = seed;
  return scene;
}

// Largest ratio of the chi-square of an inlier to its limit.
double WorstInlier(const BundleAdjustmentOptions& options, const WindowData& data) {
  double worst = 0.0;
  for (const auto& o : data.point_observations) {
    if (o.rejected) continue;
    const Eigen::Vector3d x =
        Find(data.keyframes, o.keyframe).cam_from_world * Find(data.points, o.point).position;
    const double chi2 = ((data.camera.Project(x) - o.pixel) / o.sigma).squaredNorm();
    worst = std::max(worst, chi2 / options.reject_chi2_2);
  }
  for (const auto& o : data.line_observations) {
    if (o.rejected) continue;
    const LineSegment3 line =
        Find(data.keyframes, o.keyframe).cam_from_world * Find(data.lines, o.line).segment;
    const std::optional<LinePart> part = ObservedPart(data.camera, o.segment, line);
    if (!part) return 1e9;
    const double chi2 = LineResidual(data.camera, o.segment, o.sigma, part->Of(line)).squaredNorm();
    worst = std::max(worst, chi2 / options.reject_chi2_2);
  }
  return worst;
}

// Sums over solved windows.
struct Outcome {
  int num_outliers = 0, num_unmarked = 0, num_inliers = 0, num_inliers_rejected = 0;
  double worst_inlier = 0.0;
  double mean_error = 0.0;  // squared Mahalanobis error of poses per degree of freedom
  double median_error = 0.0;

  template <typename Observations>
  void Count(const Observations& observations, const std::vector<bool>& outliers) {
    for (size_t i = 0; i < observations.size(); ++i) {
      (outliers[i] ? num_outliers : num_inliers) += 1;
      num_unmarked += outliers[i] && !observations[i].rejected;
      num_inliers_rejected += !outliers[i] && observations[i].rejected;
    }
  }
};

void AddPoseErrors(const BundleAdjustmentOptions& options, const WindowData& truth,
                   const WindowData& solved, std::vector<double>* errors) {
  CovarianceSelection free;
  for (const auto& k : solved.keyframes) {
    if (!k.fixed) free.keyframes.push_back(k.id);
  }
  const WindowCovariance covariance = EstimateCovariance(options, solved, free);
  for (size_t i = 0; i < free.keyframes.size(); ++i) {
    if (!covariance.keyframes[i]) continue;
    Eigen::Matrix<double, 6, 1> error;
    Rigid3Manifold().Minus(Find(solved.keyframes, free.keyframes[i]).cam_from_world.params.data(),
                           Find(truth.keyframes, free.keyframes[i]).cam_from_world.params.data(),
                           error.data());
    errors->push_back(error.dot(covariance.keyframes[i]->inverse() * error) / 6.0);
  }
}

// Solves windows `times` times, each from the result of the time before.
Outcome SolveWindows(const BundleAdjustmentOptions& options, const Content& content,
                     double gross_error_ratio, int num_windows, int times = 1) {
  Outcome outcome;
  std::vector<double> errors;
  for (int i = 0; i < num_windows; ++i) {
    const TestWindow window = MakeTestWindow(Scene(content, gross_error_ratio, 1 + i));
    WindowData data = window.data;
    for (int k = 0; k < times; ++k) {
      EXPECT_TRUE(LocalBundleAdjustment(options, &data).usable);
    }
    outcome.Count(data.point_observations, window.point_outliers);
    outcome.Count(data.line_observations, window.line_outliers);
    outcome.worst_inlier = std::max(outcome.worst_inlier, WorstInlier(options, data));
    AddPoseErrors(options, window.truth, data, &errors);
  }
  std::sort(errors.begin(), errors.end());
  for (const double error : errors) outcome.mean_error += error / double(errors.size());
  outcome.median_error = errors[errors.size() / 2];
  return outcome;
}

BundleAdjustmentOptions WithoutConsensus() {
  BundleAdjustmentOptions options;
  options.consensus.enabled = false;
  return options;
}

class GrossErrorsTest : public ::testing::TestWithParam<Content> {};

TEST_P(GrossErrorsTest, AreMarked) {
  const Outcome outcome = SolveWindows({}, GetParam(), 0.05, 100);
  EXPECT_GT(outcome.num_outliers, 250);
  EXPECT_LE(outcome.num_unmarked, 0.05 * outcome.num_outliers);
  EXPECT_LE(outcome.num_inliers_rejected, 0.05 * outcome.num_inliers);
}

TEST_P(GrossErrorsTest, InliersAreWithinTheLimitAtTheSolution) {
  for (const auto solver : {BundleAdjustmentSolver::kBlockSchur, BundleAdjustmentSolver::kCeres}) {
    BundleAdjustmentOptions options;
    options.solver = solver;
    if (!IsAvailable(solver)) continue;
    EXPECT_LE(SolveWindows(options, GetParam(), 0.05, 30).worst_inlier, 1.0);
  }
  EXPECT_GT(SolveWindows(WithoutConsensus(), GetParam(), 0.05, 100).worst_inlier, 1.0);
}

// Median of chi-square with six degrees of freedom, divided by six, its density there, and the 99 %
// bound on the error of the median of n windows; the poses of a window are correlated.
constexpr double kMedian = 0.891, kDensity = 0.740;
double MedianBound(int n) { return 2.576 * 0.5 / (kDensity * std::sqrt(n)); }

TEST_P(GrossErrorsTest, CovariancesOfPosesContainTheErrors) {
  constexpr int kWindows = 100;
  for (const double ratio : {0.0, 0.05}) {
    const Outcome outcome = SolveWindows({}, GetParam(), ratio, kWindows);
    // Of lines alone, a few windows of hundred have a pose that wrong marks have moved.
    if (ratio == 0.0 || GetParam().num_points > 0) {
      EXPECT_GT(outcome.mean_error, 0.9) << ratio;
      EXPECT_LT(outcome.mean_error, 1.2) << ratio;
    }
    EXPECT_NEAR(outcome.median_error, kMedian, MedianBound(kWindows)) << ratio;
  }
}

TEST_P(GrossErrorsTest, SolvingAgainMarksAsMany) {
  const Outcome once = SolveWindows({}, GetParam(), 0.05, 100);
  const Outcome twice = SolveWindows({}, GetParam(), 0.05, 100, 2);
  // The first solve has all observations again, and moves the poses with which fits begin.
  EXPECT_LE(twice.num_unmarked, once.num_unmarked + 0.04 * once.num_outliers);
  EXPECT_LE(twice.worst_inlier, 1.0);
  EXPECT_NEAR(twice.median_error, once.median_error, 0.1);
}

INSTANTIATE_TEST_SUITE_P(Contents, GrossErrorsTest, ::testing::Values(kPoints, kMixed, kLines),
                         [](const auto& content) { return std::string(content.param.name); });

TEST(GrossErrorsTest, OfLinesRemainWithoutTheConsensus) {
  const Outcome outcome = SolveWindows(WithoutConsensus(), kLines, 0.05, 100);
  EXPECT_GT(outcome.num_unmarked, 0.2 * outcome.num_outliers);
}

TEST(UndeterminedTest, LinesAlongTheMotion) {
  TestWindowOptions scene = Scene(kMixed, 0.0, 1);
  scene.perturbation = 0.0;
  const TestWindow window = MakeTestWindow(scene);
  WindowData data = window.data;
  for (auto& k : data.keyframes) k.fixed = true;
  const BundleAdjustmentSummary summary = LocalBundleAdjustment({}, &data);
  std::vector<int64_t> along;
  for (size_t i = 0; i < data.lines.size(); i += 2) along.push_back(data.lines[i].id);
  EXPECT_EQ(summary.undetermined_lines, along);
  EXPECT_THAT(summary.undetermined_points, ::testing::IsEmpty());
  EXPECT_THAT(summary.undetermined_keyframes, ::testing::IsEmpty());
  EXPECT_THAT(summary.BriefReport(), LineNames("0 keyframes", "0 points", "6 lines"));
  const WindowCovariance covariance =
      EstimateCovariance({}, data, {{}, {}, {data.lines[0].id, data.lines[1].id}});
  EXPECT_FALSE(covariance.lines[0].has_value());
  EXPECT_TRUE(covariance.lines[1].has_value());
  // They remain where they are, in their planes.
  for (size_t i = 0; i < data.lines.size(); ++i) {
    EXPECT_LT((data.lines[i].segment.start - window.truth.lines[i].segment.start).norm(), 0.1);
  }
}

TEST(UndeterminedTest, AreNotListedWithoutTheConsensus) {
  WindowData data = MakeTestWindow(Scene(kMixed, 0.0, 1)).data;
  const BundleAdjustmentSummary summary = LocalBundleAdjustment(WithoutConsensus(), &data);
  EXPECT_THAT(summary.undetermined_lines, ::testing::IsEmpty());
}

TEST(UndeterminedTest, OnePointAndOneFreePose) {
  WindowData data = MakeTestWindow(Scene(kPoints, 0.0, 1)).data;
  data.keyframes.erase(data.keyframes.begin() + 1, data.keyframes.end() - 1);
  data.points.resize(1);
  const auto is_gone = [&data](const WindowData::PointObservation& o) {
    return o.point != data.points[0].id || o.keyframe != data.keyframes[1].id;
  };
  auto& observations = data.point_observations;
  observations.erase(std::remove_if(observations.begin(), observations.end(), is_gone),
                     observations.end());
  ASSERT_EQ(observations.size(), 1u);
  const BundleAdjustmentSummary summary = LocalBundleAdjustment({}, &data);
  ASSERT_TRUE(summary.usable);
  EXPECT_EQ(summary.undetermined_keyframes, std::vector<int64_t>{data.keyframes[1].id});
  EXPECT_EQ(summary.undetermined_points, std::vector<int64_t>{data.points[0].id});
}

}  // namespace
}  // namespace msc_vo
