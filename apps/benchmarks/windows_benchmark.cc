// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Local bundle adjustment of windows with every solver. The baseline is the first of them, Ceres
// with Eigen's factorisation. "speedup" is the ratio of the baseline's time to the solver's,
// "cost_change" the relative difference of the final costs. Window files:
// MSC_VO_WINDOWS=a.txt:b.txt.

#include <algorithm>
#include <array>
#include <map>

#include <benchmark/benchmark.h>

#include "apps/benchmarks/benchmark_windows.h"
#include "msc_vo/timing/stopwatch.h"

namespace msc_vo {

namespace {

struct Variant {
  const char* name;
  BundleAdjustmentSolver solver;
};
constexpr Variant kVariants[] = {
    {"ceres", BundleAdjustmentSolver::kCeres},
    {"ceres_suite_sparse", BundleAdjustmentSolver::kCeresSuiteSparse},
    {"block_schur", BundleAdjustmentSolver::kBlockSchur},
};

BundleAdjustmentOptions OptionsOf(const Variant& variant, const NamedWindow& window) {
  BundleAdjustmentOptions options = window.Get().options;
  options.solver = variant.solver;
  return options;
}

// Accumulates the milliseconds of each stage.
class StageClock {
 public:
  void Enter(WindowStage stage) {
    const double milliseconds = stopwatch_.Restart();
    if (running_) sums_[static_cast<int>(current_)] += milliseconds;
    running_ = stage != WindowStage::kDone;
    current_ = stage;
  }
  double Of(WindowStage stage) const { return sums_[static_cast<int>(stage)]; }

 private:
  Stopwatch stopwatch_;
  bool running_ = false;
  WindowStage current_ = WindowStage::kDone;
  std::array<double, 5> sums_{};
};

struct Baseline {
  double milliseconds = 0.0;  // best of three
  double cost = 0.0;
};

// Solves the window with the baseline at its first use.
const Baseline& BaselineOf(const NamedWindow& window) {
  static std::map<std::string, Baseline> baselines;
  const auto [it, is_new] = baselines.emplace(window.name(), Baseline());
  if (!is_new) return it->second;
  for (int i = 0; i < 3; ++i) {
    WindowData data = window.Get().data;
    const Stopwatch stopwatch;
    const BundleAdjustmentSummary summary =
        LocalBundleAdjustment(OptionsOf(kVariants[0], window), &data);
    const double milliseconds = stopwatch.Milliseconds();
    it->second.cost = summary.final_cost;
    it->second.milliseconds =
        i == 0 ? milliseconds : std::min(it->second.milliseconds, milliseconds);
  }
  return it->second;
}

void Solve(benchmark::State& state, const Variant& variant, const NamedWindow& window) {
  const BundleAdjustmentOptions options = OptionsOf(variant, window);
  const Baseline& baseline = BaselineOf(window);
  StageClock clock;
  BundleAdjustmentSummary summary;
  Stopwatch stopwatch;
  double best = 1e9;
  for (auto _ : state) {
    state.PauseTiming();
    WindowData data = window.Get().data;
    state.ResumeTiming();
    stopwatch.Restart();
    summary =
        LocalBundleAdjustment(options, &data, [&clock](WindowStage stage) { clock.Enter(stage); });
    best = std::min(best, stopwatch.Milliseconds());
  }
  if (!summary.usable) state.SkipWithError(summary.message.c_str());
  const double solves = static_cast<double>(state.iterations());
  state.counters["best_ms"] = best;
  state.counters["build_ms"] = clock.Of(WindowStage::kBuild) / solves;
  state.counters["linearize_ms"] = clock.Of(WindowStage::kLinearize) / solves;
  state.counters["step_ms"] = clock.Of(WindowStage::kStep) / solves;
  state.counters["write_ms"] = clock.Of(WindowStage::kWriteBack) / solves;
  state.counters["steps"] = summary.num_iterations;
  state.counters["speedup"] = baseline.milliseconds / best;
  state.counters["cost_change"] = summary.final_cost / baseline.cost - 1.0;
  const WindowData& data = window.Get().data;
  state.SetLabel(summary.schur_structure + ", " + std::to_string(data.points.size()) + " points " +
                 std::to_string(data.lines.size()) + " lines " +
                 std::to_string(data.point_observations.size()) + "+" +
                 std::to_string(data.line_observations.size()) + " observations");
}

void Register(const WindowPtr& window) {
  for (const Variant& variant : kVariants) {
    BundleAdjustmentOptions options;
    options.solver = variant.solver;
    std::string error;
    if (!options.IsValid(&error)) continue;  // not supported by this build of Ceres
    benchmark::RegisterBenchmark(
        (window->name() + "/" + variant.name).c_str(),
        [&variant, window](benchmark::State& state) { Solve(state, variant, *window); })
        ->Unit(benchmark::kMillisecond);
  }
}

}  // namespace

}  // namespace msc_vo

int main(int argc, char** argv) {
  using msc_vo::WindowContent;
  return msc_vo::RunWindowBenchmarks(
      argc, argv, {5, 10, 20, 40},
      {WindowContent::kPoints, WindowContent::kLines, WindowContent::kStructure}, msc_vo::Register);
}
