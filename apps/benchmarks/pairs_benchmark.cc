// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Alternative treatments of line pairs in the Schur complement (docs/lab/bundle_adjustment.md), for
// the first of the two solves of a window. Window files: MSC_VO_WINDOWS=a.txt:b.txt.

#include <algorithm>
#include <map>

#include <Eigen/Cholesky>
#include <benchmark/benchmark.h>

#include "apps/benchmarks/benchmark_windows.h"
#include "msc_vo/bundle_adjustment/internal/block_schur_backend.h"
#include "msc_vo/bundle_adjustment/internal/inlier_classification.h"

namespace msc_vo {

namespace {

constexpr int kMaxIterations = 50;

// Keeps the directions of all paired lines in the reduced system.
void KeepAllPaired(BlockStructure* structure) {
  std::vector<bool> paired(structure->num_lines, false);
  for (const auto& [a, b] : structure->line_pairs) paired[a] = paired[b] = true;
  structure->num_reduced_lines = 0;
  for (int i = 0; i < structure->num_lines; ++i) {
    structure->reduced_line[i] = paired[i] ? structure->num_reduced_lines++ : -1;
  }
}

// Treats the partners of every line as constant during a step: no pair couples two unknowns.
void HoldPartners(BlockStructure* structure) {
  structure->line_pairs.clear();
  structure->reduced_line.assign(structure->num_lines, -1);
  structure->num_reduced_lines = 0;
}

// Replaces the pairs among parallel lines by a star around one of them, the sparsity of one common
// direction per family, and perpendicular pairs by pairs of the centres. The cost differs from that
// of the window; only sparsity and time are comparable.
WindowData WithStars(const WindowData& data) {
  std::map<int64_t, int64_t> parents;
  const auto centre = [&parents](int64_t line) {
    while (parents.count(line) > 0 && parents[line] != line) line = parents[line];
    return line;
  };
  for (const WindowData::LinePair& pair : data.parallel_pairs) {
    const int64_t a = centre(pair.a), b = centre(pair.b);
    parents[std::max(a, b)] = std::min(a, b);
  }
  WindowData stars = data;
  if (data.parallel_pairs.empty()) return stars;
  stars.parallel_pairs.clear();
  stars.perpendicular_pairs.clear();
  for (const WindowData::Line& line : data.lines) {
    if (centre(line.id) == line.id) continue;
    stars.parallel_pairs.push_back({centre(line.id), line.id, data.parallel_pairs.front().sigma});
  }
  std::map<std::pair<int64_t, int64_t>, WindowData::LinePair> of_centres;
  for (const WindowData::LinePair& pair : data.perpendicular_pairs) {
    const int64_t a = centre(pair.a), b = centre(pair.b);
    if (a == b) continue;
    of_centres[{std::min(a, b), std::max(a, b)}] = {std::min(a, b), std::max(a, b), pair.sigma};
  }
  for (const auto& [ids, pair] : of_centres) stars.perpendicular_pairs.push_back(pair);
  return stars;
}

using Change = void (*)(BlockStructure*);

void Minimize(benchmark::State& state, const BenchmarkWindow& window, Change change) {
  const WindowIndex index = ValidateWindow(window.options, window.data);
  int num_behind = 0;
  const WindowInlierMask inlier_mask =
      InitialInlierMask(window.options, index, window.data, &num_behind);
  const WindowState start(window.data);
  const WindowTerms terms = MakeWindowTerms(window.options, window.data, index, inlier_mask, start);
  BlockStructure structure(window.data, terms, start);
  if (change != nullptr) {
    change(&structure);
    structure.AssignRows();
  }
  MinimizerReport report;
  WindowState end = start;
  for (auto _ : state) {
    end = start;
    report = MinimizeWithBlockSchur(structure, terms, kMaxIterations, {}, &end);
  }
  WindowEquations equations;
  Linearize(structure, terms, end, &equations);
  state.counters["steps"] = report.num_iterations;
  state.counters["ms_per_iteration"] =
      benchmark::Counter(1e-3 * static_cast<double>(state.iterations() * report.num_iterations),
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["reduced_size"] = structure.reduced_size;
  state.counters["cost"] = equations.cost;
}

// Time of the Cholesky factorisation of a reduced system by its size.
void ReducedCholesky(benchmark::State& state) {
  const int size = static_cast<int>(state.range(0));
  const Eigen::MatrixXd matrix = Eigen::MatrixXd::Constant(size, size, 0.5 / size) +
                                 Eigen::MatrixXd(Eigen::MatrixXd::Identity(size, size));
  for (auto _ : state) {
    Eigen::MatrixXd copy = matrix;
    const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> cholesky(copy);
    benchmark::DoNotOptimize(cholesky.info());
  }
}
BENCHMARK(ReducedCholesky)
    ->Arg(60)
    ->Arg(120)
    ->Arg(240)
    ->Arg(360)
    ->Arg(480)
    ->Arg(960)
    ->Unit(benchmark::kMillisecond);

void Register(const WindowPtr& window) {
  const auto add = [](const WindowPtr& input, const char* name, Change change) {
    benchmark::RegisterBenchmark(
        (input->name() + "/" + name).c_str(),
        [input, change](benchmark::State& state) { Minimize(state, input->Get(), change); })
        ->Unit(benchmark::kMillisecond);
  };
  add(window, "few_directions_kept", nullptr);
  add(window, "all_directions_kept", KeepAllPaired);
  add(window, "partners_held", HoldPartners);
  const auto with_stars = [window] {
    return BenchmarkWindow{window->Get().options, WithStars(window->Get().data)};
  };
  add(std::make_shared<NamedWindow>(window->name(), with_stars), "stars", nullptr);
}

}  // namespace

}  // namespace msc_vo

int main(int argc, char** argv) {
  return msc_vo::RunWindowBenchmarks(argc, argv, {5, 10, 20}, {msc_vo::WindowContent::kStructure},
                                     msc_vo::Register);
}
