// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/self_calibration/noise_estimator.h"

#include <map>
#include <random>

#include <gmock/gmock.h>

#include "msc_vo/bundle_adjustment/local_bundle_adjustment.h"
#include "msc_vo/synthetic/window/synthetic_window.h"

namespace msc_vo {
namespace {

constexpr int kWindows = 3;

WindowData NoisyWindow(int seed) {
  SyntheticWindowOptions options;
  options.seed = static_cast<uint64_t>(seed);
  options.num_points = 200;
  options.num_lines = 1;  // few: the test is about points
  return MakeSyntheticWindow(options).data;
}

// A weak prior, so that few windows suffice.
NoiseEstimatorOptions QuickOptions() {
  NoiseEstimatorOptions options;
  options.prior = 2.0;
  return options;
}

// Scale of point depths after kWindows windows, whose observations `disturb` may change.
template <typename Disturb>
double EstimateScale(const NoiseEstimatorOptions& options, const Disturb& disturb) {
  NoiseEstimator noise(options);
  for (int seed = 1; seed <= kWindows; ++seed) {
    WindowData window = NoisyWindow(seed);
    disturb(&window);
    noise.Apply(&window);
    EXPECT_TRUE(LocalBundleAdjustment(BundleAdjustmentOptions(), &window).usable);
    noise.Update(WindowResiduals(window));
  }
  return noise.scale().point_depth;
}

void MultiplySigmas(double factor, WindowData* window) {
  for (auto& o : window->point_observations) o.inverse_depth_sigma *= factor;
  for (auto& o : window->line_observations) o.depth.covariance *= factor * factor;
}

TEST(NoiseEstimator, KeepsCorrectSigmas) {
  // The poses of a small window absorb a part of the errors that are common to image quadrants.
  const double scale = EstimateScale(QuickOptions(), [](WindowData*) {});
  EXPECT_GT(scale, 0.75);
  EXPECT_LT(scale, 1.1);
}

TEST(NoiseEstimator, EstimatesWrongSigmasOfPointDepths) {
  const auto scale = [](double factor) {
    return EstimateScale(QuickOptions(), [&](WindowData* w) { MultiplySigmas(factor, w); });
  };
  // The part that the poses absorb cancels in the ratio.
  EXPECT_NEAR(scale(2.0) / scale(1.0), 0.5, 0.1);
  EXPECT_NEAR(scale(0.5) / scale(1.0), 2.0, 0.2);
}

TEST(NoiseEstimator, WeightsErrorsCommonToAnImageQuadrant) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  const double scale = EstimateScale(QuickOptions(), [&](WindowData* window) {
    std::map<std::pair<int64_t, int>, double> common;  // in sigmas
    for (auto& o : window->point_observations) {
      const int quadrant = (o.pixel.x() < 0.5 * window->camera.width ? 0 : 1) +
                           (o.pixel.y() < 0.5 * window->camera.height ? 0 : 2);
      const auto [error, is_new] = common.emplace(std::pair(o.keyframe, quadrant), 0.0);
      if (is_new) error->second = normal(random);
      o.inverse_depth += error->second * o.inverse_depth_sigma;
    }
  });
  // The spread of single errors has increased by sqrt(2) only.
  EXPECT_GT(scale, 2.0);
}

TEST(NoiseEstimator, IsRobustAgainstGrossErrors) {
  const double scale = EstimateScale(QuickOptions(), [](WindowData* window) {
    for (size_t i = 0; i < window->point_observations.size(); i += 50) {
      window->point_observations[i].inverse_depth *= 2.0;
    }
  });
  EXPECT_NEAR(scale, 1.0, 0.2);
}

TEST(NoiseEstimator, BoundsTheScale) {
  const auto scale = [](double factor) {
    return EstimateScale(QuickOptions(), [&](WindowData* w) { MultiplySigmas(factor, w); });
  };
  constexpr double kBound = NoiseEstimator::kMaxScale;
  EXPECT_EQ(scale(4.0 * kBound), 1.0 / kBound);
  EXPECT_EQ(scale(0.25 / kBound), kBound);
}

TEST(NoiseEstimator, ScalesAllObservations) {
  NoiseEstimator noise(QuickOptions());
  WindowData window = NoisyWindow(1);
  for (auto& o : window.point_observations) o.inverse_depth_sigma *= 0.1;
  noise.Update(WindowResiduals(window));
  ASSERT_GT(noise.scale().point_depth, 1.0);
  WindowData scaled = window;
  noise.Apply(&scaled);
  const auto &point = window.point_observations[0], &scaled_point = scaled.point_observations[0];
  EXPECT_DOUBLE_EQ(scaled_point.inverse_depth_sigma,
                   noise.scale().point_depth * point.inverse_depth_sigma);
  EXPECT_EQ(scaled_point.sigma, point.sigma);
  const auto &line = window.line_observations[0], &scaled_line = scaled.line_observations[0];
  EXPECT_NEAR(scaled_line.depth.SigmaAt(0.3), noise.scale().line_depth * line.depth.SigmaAt(0.3),
              1e-15);
  EXPECT_DOUBLE_EQ(scaled_line.sigma, noise.scale().line_pixel * line.sigma);
}

// Scale of lines in the image if their sigmas are `factor` times too large and every
// `outlier_period`-th observation has an error of 20 px.
double EstimateLinePixelScale(double factor, size_t outlier_period) {
  NoiseEstimator noise(QuickOptions());
  SyntheticWindowOptions options;
  options.num_points = 40;
  options.num_lines = 40;
  for (int seed = 1; seed <= kWindows; ++seed) {
    options.seed = static_cast<uint64_t>(seed);
    WindowData window = MakeSyntheticWindow(options).data;
    for (size_t i = 0; i < window.line_observations.size(); ++i) {
      auto& o = window.line_observations[i];
      o.sigma *= factor;
      if (i % outlier_period != 0) continue;
      o.segment.start.y() += 20.0;
      o.segment.end.y() += 20.0;
    }
    noise.Apply(&window);
    EXPECT_TRUE(LocalBundleAdjustment(BundleAdjustmentOptions(), &window).usable);
    noise.Update(WindowResiduals(window));
  }
  return noise.scale().line_pixel;
}

TEST(NoiseEstimator, EstimatesWrongSigmasOfLinesInTheImage) {
  constexpr size_t kNever = 1000000;
  EXPECT_NEAR(EstimateLinePixelScale(1.0, kNever), 1.0, 0.15);
  EXPECT_NEAR(EstimateLinePixelScale(2.0, kNever), 0.5, 0.1);
  EXPECT_NEAR(EstimateLinePixelScale(0.5, kNever), 2.0, 0.3);
  // With one outlier in ten, most of which are rejected.
  EXPECT_NEAR(EstimateLinePixelScale(1.0, 10), 1.0, 0.15);
}

TEST(NoiseEstimator, EstimatesDepthScalesOfPointsAndLinesSeparately) {
  NoiseEstimator noise(QuickOptions());
  SyntheticWindowOptions options;
  options.num_points = 60;
  options.num_lines = 60;
  for (int seed = 1; seed <= 2 * kWindows; ++seed) {
    options.seed = static_cast<uint64_t>(seed);
    WindowData window = MakeSyntheticWindow(options).data;
    for (auto& o : window.line_observations) o.depth.covariance *= 0.25;
    noise.Apply(&window);
    ASSERT_TRUE(LocalBundleAdjustment(BundleAdjustmentOptions(), &window).usable);
    noise.Update(WindowResiduals(window));
  }
  EXPECT_GT(noise.scale().line_depth, 1.4);
  EXPECT_LT(noise.scale().point_depth, 1.2);
}

TEST(NoiseEstimator, KeepsTheScaleWithoutDepthsOrIfDisabled) {
  const auto remove_depths = [](WindowData* window) {
    for (auto& o : window->point_observations) o.inverse_depth = 0.0;
  };
  EXPECT_EQ(EstimateScale(QuickOptions(), remove_depths), 1.0);
  NoiseEstimatorOptions off = QuickOptions();
  off.enabled = false;
  EXPECT_EQ(EstimateScale(off, [](WindowData* w) { MultiplySigmas(2.0, w); }), 1.0);
}

TEST(NoiseEstimator, RejectsInvalidOptions) {
  NoiseEstimatorOptions options;
  options.prior = 0.0;
  EXPECT_THROW(NoiseEstimator{options}, std::invalid_argument);
  options = {};
  options.prior = 1e6;  // more than the estimate ever depends on
  EXPECT_THROW(NoiseEstimator{options}, std::invalid_argument);
}

}  // namespace
}  // namespace msc_vo
