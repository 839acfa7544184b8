// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// The time to publish a snapshot of the map, as the mapper does after every keyframe, and to modify
// the map afterwards.

#include <memory>
#include <vector>

#include <benchmark/benchmark.h>

#include "msc_vo/map/snapshot.h"

namespace msc_vo {

namespace {

// Typical of a run: every keyframe adds new landmarks and observes those of the keyframes before.
constexpr int kNewPoints = 75;
constexpr int kNewLines = 13;
constexpr int kObservingKeyframes = 7;

Map MakeMap(int num_keyframes) {
  auto frame = std::make_shared<Frame>();
  frame->points.resize(kObservingKeyframes * kNewPoints);
  frame->lines.resize(kObservingKeyframes * kNewLines);
  Map map;
  std::vector<LandmarkId> points, lines;
  for (int i = 0; i < num_keyframes; ++i) {
    const KeyframeId keyframe = map.AddKeyframe(frame, Rigid3());
    const size_t num_points = points.size();
    const size_t num_lines = lines.size();
    for (int j = 0; j < kNewPoints; ++j) {
      points.push_back(map.Add<PointLandmark>(keyframe, j, Eigen::Vector3d(0.0, 0.0, 2.0)));
    }
    for (int j = 0; j < kNewLines; ++j) {
      lines.push_back(map.Add<LineLandmark>(keyframe, j, {{0.0, 0.0, 2.0}, {1.0, 0.0, 2.0}}));
    }
    for (size_t j = kNewPoints; j < frame->points.size() && j - kNewPoints < num_points; ++j) {
      map.Observe<PointLandmark>(points[num_points - 1 - (j - kNewPoints)], keyframe,
                                 static_cast<int>(j));
    }
    for (size_t j = kNewLines; j < frame->lines.size() && j - kNewLines < num_lines; ++j) {
      map.Observe<LineLandmark>(lines[num_lines - 1 - (j - kNewLines)], keyframe,
                                static_cast<int>(j));
    }
  }
  return map;
}

// Arguments: number of keyframes in the map, and number of points that are modified before each
// snapshot, the newest ones. The previous snapshot is released, as in tracking.
void Snapshot(benchmark::State& state) {
  Map map = MakeMap(static_cast<int>(state.range(0)));
  std::vector<LandmarkId> moved;
  for (const auto& [id, point] : map.points()) moved.push_back(id);
  moved.erase(moved.begin(), moved.end() - state.range(1));
  MapSnapshotPtr newest;
  for (auto _ : state) {
    for (const LandmarkId id : moved)
      map.SetGeometry<PointLandmark>(id, Eigen::Vector3d(0.0, 0.0, 3.0));
    auto snapshot = std::make_shared<MapSnapshot>();
    snapshot->map = map.Share();
    newest = std::move(snapshot);
  }
  state.counters["points"] = static_cast<double>(map.points().size());
  state.counters["lines"] = static_cast<double>(map.lines().size());
}
BENCHMARK(Snapshot)->ArgsProduct({{15, 60, 240}, {0, 1000}})->Unit(benchmark::kMillisecond);

}  // namespace

}  // namespace msc_vo
