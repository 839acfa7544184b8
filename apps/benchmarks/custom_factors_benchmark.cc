// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Cost of custom factors in local bundle adjustment by block Schur: 20 factors with automatic
// derivatives between the poses of consecutive keyframes. Windows without and with them are solved
// alternately; "ratio" is that of their median times. Window files: MSC_VO_WINDOWS=a.txt:b.txt.

#include <algorithm>
#include <memory>
#include <vector>

#include <benchmark/benchmark.h>

#include "apps/benchmarks/benchmark_windows.h"
#include "msc_vo/factors/relative_pose.h"
#include "msc_vo/timing/stopwatch.h"

namespace msc_vo {

namespace {

constexpr size_t kNumFactors = 20;

void AddRelativePoses(WindowData* data) {
  const RelativePose::Matrix6d covariance = RelativePose::Matrix6d::Identity() * 1e-4;
  for (size_t i = 0; i < kNumFactors; ++i) {
    const WindowData::Keyframe& a = data->keyframes[i % (data->keyframes.size() - 1)];
    const WindowData::Keyframe& b = *(&a + 1);
    CustomFactor factor;
    factor.name = "relative pose";
    factor.cost =
        RelativePose::CreateShared(b.cam_from_world * a.cam_from_world.Inverse(), covariance);
    factor.blocks = {BlockId::Pose(a.id), BlockId::Pose(b.id)};
    data->custom_factors.push_back(factor);
  }
}

double Median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

// Returns the milliseconds of one solve.
double Solve(const BundleAdjustmentOptions& options, WindowData data) {
  const Stopwatch stopwatch;
  benchmark::DoNotOptimize(LocalBundleAdjustment(options, &data).final_cost);
  return stopwatch.Milliseconds();
}

void Compare(benchmark::State& state, const NamedWindow& window) {
  BundleAdjustmentOptions options = window.Get().options;
  options.solver = BundleAdjustmentSolver::kBlockSchur;
  const WindowData& without = window.Get().data;
  WindowData with = without;
  AddRelativePoses(&with);
  std::vector<double> times_without, times_with;
  for (auto _ : state) {
    times_without.push_back(Solve(options, without));
    times_with.push_back(Solve(options, with));
  }
  state.counters["without_ms"] = Median(times_without);
  state.counters["with_ms"] = Median(times_with);
  state.counters["ratio"] = Median(times_with) / Median(times_without);
}

void Register(const WindowPtr& window) {
  benchmark::RegisterBenchmark(window->name().c_str(), [window](benchmark::State& state) {
    Compare(state, *window);
  })->Unit(benchmark::kMillisecond);
}

}  // namespace

}  // namespace msc_vo

int main(int argc, char** argv) {
  return msc_vo::RunWindowBenchmarks(argc, argv, {5, 10, 20}, {msc_vo::WindowContent::kStructure},
                                     msc_vo::Register);
}
