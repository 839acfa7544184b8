// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/mapping/depth_noise.h"

#include <map>
#include <random>

#include <gmock/gmock.h>

#include "msc_vo/problems/window_problem.h"
#include "msc_vo/synthetic/synthetic_window.h"

namespace msc_vo {
namespace {

constexpr int kWindows = 3;

WindowData NoisyWindow(int seed) {
  SyntheticWindowOptions options;
  options.seed = static_cast<uint64_t>(seed);
  options.num_points = 200;
  options.num_lines = 1;  // few: they say nothing about the noise of points
  return MakeSyntheticWindow(options).data;
}

// Those of a run want more windows until they believe.
DepthNoiseOptions QuickOptions() {
  DepthNoiseOptions options;
  options.prior = 2.0;
  return options;
}

// The scale after some windows whose depth errors `disturb` may change.
template <typename Disturb>
double LearntScale(const DepthNoiseOptions& options, const Disturb& disturb) {
  DepthNoise noise(options);
  for (int seed = 1; seed <= kWindows; ++seed) {
    WindowData window = NoisyWindow(seed);
    disturb(&window);
    noise.Apply(&window);
    EXPECT_TRUE(SolveWindow(WindowOptions(), &window).usable);
    noise.Update(window);
  }
  return noise.scale().points;
}

void MultiplySigmas(double factor, WindowData* window) {
  for (auto& o : window->point_observations) o.inverse_depth_sigma *= factor;
  for (auto& o : window->line_observations) o.depth.covariance *= factor * factor;
}

TEST(DepthNoise, RightSigmasStay) {
  // The poses of a small window take up a part of what the quarters of its images have in common.
  const double scale = LearntScale(QuickOptions(), [](WindowData*) {});
  EXPECT_GT(scale, 0.75);
  EXPECT_LT(scale, 1.1);
}

TEST(DepthNoise, FindsSigmasThatAreTooLargeOrTooSmall) {
  EXPECT_NEAR(LearntScale(QuickOptions(), [](WindowData* w) { MultiplySigmas(2.0, w); }), 0.5, 0.1);
  EXPECT_NEAR(LearntScale(QuickOptions(), [](WindowData* w) { MultiplySigmas(0.5, w); }), 2.0, 0.3);
}

TEST(DepthNoise, ErrorsThatAQuarterOfAnImageSharesCountMore) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  const double scale = LearntScale(QuickOptions(), [&](WindowData* window) {
    std::map<std::pair<int64_t, int>, double> shared;  // in sigmas
    for (auto& o : window->point_observations) {
      const int quarter = (o.pixel.x() < 0.5 * window->camera.width ? 0 : 1) +
                          (o.pixel.y() < 0.5 * window->camera.height ? 0 : 2);
      const auto [error, is_new] = shared.emplace(std::pair(o.keyframe, quarter), 0.0);
      if (is_new) error->second = normal(random);
      o.inverse_depth += error->second * o.inverse_depth_sigma;
    }
  });
  // The spread of single errors has grown by sqrt(2) only.
  EXPECT_GT(scale, 2.0);
}

TEST(DepthNoise, FewGrossErrorsChangeLittle) {
  const double scale = LearntScale(QuickOptions(), [](WindowData* window) {
    for (size_t i = 0; i < window->point_observations.size(); i += 50) {
      window->point_observations[i].inverse_depth *= 2.0;
    }
  });
  EXPECT_NEAR(scale, 1.0, 0.2);
}

TEST(DepthNoise, IsBounded) {
  DepthNoiseOptions options = QuickOptions();
  options.max_scale = 1.5;
  EXPECT_EQ(LearntScale(options, [](WindowData* w) { MultiplySigmas(4.0, w); }), 1.0 / 1.5);
  EXPECT_EQ(LearntScale(options, [](WindowData* w) { MultiplySigmas(0.25, w); }), 1.5);
}

TEST(DepthNoise, AppliesToAllDepths) {
  DepthNoise noise(QuickOptions());
  WindowData window = NoisyWindow(1);
  for (auto& o : window.point_observations) o.inverse_depth_sigma *= 0.1;
  noise.Update(window);
  ASSERT_GT(noise.scale().points, 1.0);
  WindowData scaled = window;
  noise.Apply(&scaled);
  const auto &point = window.point_observations[0], &scaled_point = scaled.point_observations[0];
  EXPECT_DOUBLE_EQ(scaled_point.inverse_depth_sigma,
                   noise.scale().points * point.inverse_depth_sigma);
  EXPECT_EQ(scaled_point.sigma, point.sigma);
  const auto &line = window.line_observations[0], &scaled_line = scaled.line_observations[0];
  EXPECT_NEAR(scaled_line.depth.SigmaAt(0.3), noise.scale().lines * line.depth.SigmaAt(0.3), 1e-15);
}

TEST(DepthNoise, LinesHaveAScaleOfTheirOwn) {
  DepthNoise noise(QuickOptions());
  SyntheticWindowOptions options;
  options.num_points = 60;
  options.num_lines = 60;
  for (int seed = 1; seed <= 2 * kWindows; ++seed) {
    options.seed = static_cast<uint64_t>(seed);
    WindowData window = MakeSyntheticWindow(options).data;
    for (auto& o : window.line_observations) o.depth.covariance *= 0.25;
    noise.Apply(&window);
    ASSERT_TRUE(SolveWindow(WindowOptions(), &window).usable);
    noise.Update(window);
  }
  EXPECT_GT(noise.scale().lines, 1.4);
  EXPECT_LT(noise.scale().points, 1.2);
}

TEST(DepthNoise, WithoutDepthsOrSwitchedOffItStays) {
  const auto forget = [](WindowData* window) {
    for (auto& o : window->point_observations) o.inverse_depth = 0.0;
  };
  EXPECT_EQ(LearntScale(QuickOptions(), forget), 1.0);
  DepthNoiseOptions off = QuickOptions();
  off.enabled = false;
  EXPECT_EQ(LearntScale(off, [](WindowData* w) { MultiplySigmas(2.0, w); }), 1.0);
}

TEST(DepthNoise, RefusesBadOptions) {
  DepthNoiseOptions options;
  options.prior = 0.0;
  EXPECT_THROW(DepthNoise{options}, std::invalid_argument);
  options = {};
  options.memory = 1.0;
  EXPECT_THROW(DepthNoise{options}, std::invalid_argument);
  options = {};
  options.max_scale = 0.5;
  EXPECT_THROW(DepthNoise{options}, std::invalid_argument);
}

}  // namespace
}  // namespace msc_vo
