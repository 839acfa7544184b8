// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Local bundle adjustment of windows with every solver, and with custom factors. The baseline of
// the solvers is the first of them, Ceres with Eigen's factorisation. "speedup" is the ratio of the
// baseline's time to the solver's, "cost_change" the relative difference of the final costs. Custom
// factors: 20 with automatic derivatives between the poses of consecutive keyframes, by block
// Schur; windows without and with them are solved alternately, "ratio" is that of their median
// times. Window files: MSC_VO_WINDOWS=a.txt:b.txt.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>

#include "msc_vo/bundle_adjustment/local_bundle_adjustment.h"
#include "msc_vo/factors/relative_pose.h"
#include "msc_vo/geometry/quantile.h"
#include "msc_vo/recording/window_file.h"
#include "msc_vo/synthetic/window/synthetic_window.h"
#include "msc_vo/timing/stopwatch.h"

namespace msc_vo {

namespace {

struct BenchmarkWindow {
  BundleAdjustmentOptions options;
  WindowData data;
};

// A named window that is created or read at its first use.
class NamedWindow {
 public:
  NamedWindow(std::string name, std::function<BenchmarkWindow()> make)
      : name_(std::move(name)), make_(std::move(make)) {}

  const std::string& name() const { return name_; }
  const BenchmarkWindow& Get() const {
    if (!window_) window_ = make_();
    return *window_;
  }

 private:
  std::string name_;
  std::function<BenchmarkWindow()> make_;
  mutable std::optional<BenchmarkWindow> window_;
};
using WindowPtr = std::shared_ptr<const NamedWindow>;

enum class WindowContent { kPoints, kLines, kStructure };

constexpr int kNumFixed = 3;
constexpr int kPointsPerKeyframe = 150, kLinesPerKeyframe = 15;
constexpr int kPartners = 4;          // of each kind
constexpr double kPairSigma = 0.012;  // radians: 0.7 degrees

void AddPairs(const WindowData& truth, WindowData* data) {
  for (size_t i = 0; i < truth.lines.size(); ++i) {
    const Eigen::Vector3d direction = truth.lines[i].segment.Direction();
    int num_parallel = 0, num_perpendicular = 0;
    for (size_t j = i + 1; j < truth.lines.size(); ++j) {
      const double cosine = std::abs(direction.dot(truth.lines[j].segment.Direction()));
      const WindowData::LinePair pair{truth.lines[i].id, truth.lines[j].id, kPairSigma, 3, false};
      if (cosine > 0.9999 && num_parallel++ < kPartners) data->parallel_pairs.push_back(pair);
      if (cosine < 1e-4 && num_perpendicular++ < kPartners) {
        data->perpendicular_pairs.push_back(pair);
      }
    }
  }
}

BenchmarkWindow MakeWindow(WindowContent content, int num_keyframes) {
  SyntheticWindowOptions scene;
  scene.num_keyframes = num_keyframes + kNumFixed;
  scene.num_fixed = kNumFixed;
  scene.num_points = kPointsPerKeyframe * num_keyframes;
  scene.num_lines = content == WindowContent::kPoints ? 0 : kLinesPerKeyframe * num_keyframes;
  scene.outlier_ratio = 0.03;
  const SyntheticWindow window = MakeSyntheticWindow(scene);
  BenchmarkWindow result;
  result.data = window.data;
  if (content == WindowContent::kStructure) AddPairs(window.truth, &result.data);
  return result;
}

// A synthetic window of a furnished room: `num_keyframes` free keyframes and three fixed ones, and
// per free keyframe 150 points and, unless the content is kPoints, up to 15 lines. With kStructure,
// every line is paired with the next four parallel and the next four perpendicular lines, which is
// harder than the windows of a map, where pairs concentrate on a few lines.
WindowPtr SyntheticBenchmarkWindow(WindowContent content, int num_keyframes) {
  constexpr const char* kNames[] = {"points", "lines", "structure"};
  return std::make_shared<NamedWindow>(
      kNames[static_cast<int>(content)] + ("_" + std::to_string(num_keyframes)),
      [=] { return MakeWindow(content, num_keyframes); });
}

// The window files listed in the environment variable MSC_VO_WINDOWS, separated by colons. Throws
// std::runtime_error, naming the file, if one cannot be read.
std::vector<WindowPtr> RecordedWindows() {
  std::vector<WindowPtr> windows;
  const char* files = std::getenv("MSC_VO_WINDOWS");
  std::istringstream stream(files == nullptr ? "" : files);
  for (std::string file; std::getline(stream, file, ':');) {
    const std::filesystem::path path(file);
    windows.push_back(std::make_shared<NamedWindow>(
        path.parent_path().filename().string() + "_" + path.stem().string(), [file] {
          const RecordedWindow window = ReadWindow(file);
          return BenchmarkWindow{window.options, window.data};
        }));
    windows.back()->Get();  // report errors in the file immediately
  }
  return windows;
}

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

// Returns the milliseconds of one solve.
double MillisecondsOf(const BundleAdjustmentOptions& options, WindowData data) {
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
    times_without.push_back(MillisecondsOf(options, without));
    times_with.push_back(MillisecondsOf(options, with));
  }
  state.counters["without_ms"] = UpperMedian(times_without);
  state.counters["with_ms"] = UpperMedian(times_with);
  state.counters["ratio"] = UpperMedian(times_with) / UpperMedian(times_without);
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
  benchmark::RegisterBenchmark((window->name() + "/custom_factors").c_str(),
                               [window](benchmark::State& state) { Compare(state, *window); })
      ->Unit(benchmark::kMillisecond);
}

void RegisterAll() {
  for (const WindowPtr& window : RecordedWindows()) Register(window);
  for (const int num_keyframes : {5, 10, 20, 40}) {
    for (const WindowContent content :
         {WindowContent::kPoints, WindowContent::kLines, WindowContent::kStructure}) {
      Register(SyntheticBenchmarkWindow(content, num_keyframes));
    }
  }
}

}  // namespace

}  // namespace msc_vo

int main(int argc, char** argv) {
  try {
    msc_vo::RegisterAll();
  } catch (const std::runtime_error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
