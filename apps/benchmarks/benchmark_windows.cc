// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/benchmarks/benchmark_windows.h"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "msc_vo/recording/window_file.h"
#include "msc_vo/synthetic/window/synthetic_window.h"

namespace msc_vo {

namespace {

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

}  // namespace

WindowPtr SyntheticBenchmarkWindow(WindowContent content, int num_keyframes) {
  constexpr const char* kNames[] = {"points", "lines", "structure"};
  return std::make_shared<NamedWindow>(
      kNames[static_cast<int>(content)] + ("_" + std::to_string(num_keyframes)),
      [=] { return MakeWindow(content, num_keyframes); });
}

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

}  // namespace msc_vo
