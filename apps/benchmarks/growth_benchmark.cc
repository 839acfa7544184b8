// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// How the costs of a map grow with its keyframes: memory, a snapshot, the query of a place, the
// optimisation of a pose graph with one loop, and the map file.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>
#include <random>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>
#include <malloc.h>

#include "msc_vo/geometry/pose_covariance.h"
#include "msc_vo/geometry/so3.h"
#include "msc_vo/map/snapshot.h"
#include "msc_vo/map_file/map_reader.h"
#include "msc_vo/map_file/map_writer.h"
#include "msc_vo/place_recognition/place_index.h"
#include "msc_vo/pose_estimation/pose_graph.h"

namespace msc_vo {

namespace {

// Features of a keyframe in a run with the default options, and those that observe landmarks.
constexpr int kPoints = 1000, kLines = 150;
constexpr int kNewPoints = 75, kNewLines = 15;
constexpr int kObservingKeyframes = 7;

double MegabytesInUse() {
  const struct mallinfo2 info = mallinfo2();
  return static_cast<double>(info.uordblks + info.hblkhd) / 1e6;
}

void Randomize(std::mt19937* random, Descriptor* descriptor) {
  for (uint8_t& byte : *descriptor) byte = static_cast<uint8_t>((*random)());
}

std::shared_ptr<const Frame> RandomFrame(std::mt19937* random) {
  auto frame = std::make_shared<Frame>();
  std::uniform_real_distribution<double> x(0.0, 640.0), y(0.0, 480.0), depth(1.0, 4.0);
  frame->points.resize(kPoints);
  for (PointFeature& point : frame->points) {
    point.pixel = {x(*random), y(*random)};
    point.inverse_depth = 1.0 / depth(*random);
    point.inverse_depth_sigma = 0.003;
    Randomize(random, &point.descriptor);
  }
  frame->lines.resize(kLines);
  for (LineFeature& line : frame->lines) {
    line.segment = {{x(*random), y(*random)}, {x(*random), y(*random)}};
    line.depth = LineDepth{};
    line.depth->start = 1.0 / depth(*random);
    line.depth->end = 1.0 / depth(*random);
    line.depth->covariance = 1e-5 * Eigen::Matrix2d::Identity();
    Randomize(random, &line.descriptor);
  }
  frame->depth_ranges.cells.resize(DepthRanges::kColumns * DepthRanges::kRows, {0.3f, 0.4f});
  return frame;
}

// Adds `num_new` landmarks that a keyframe observes first, and its observations of the landmarks of
// the keyframes before it.
template <typename L, typename Geometry>
void AddLandmarks(KeyframeId keyframe, int num_new, const Geometry& geometry,
                  std::vector<LandmarkId>* ids, Map* map) {
  const int num_old = std::min<int>((kObservingKeyframes - 1) * num_new, ids->size());
  for (int i = 0; i < num_old; ++i) {
    map->Observe<L>((*ids)[ids->size() - 1 - i], keyframe, num_new + i);
  }
  for (int i = 0; i < num_new; ++i) ids->push_back(map->Add<L>(keyframe, i, geometry));
}

// A path along which every keyframe sees landmarks of the six keyframes before it.
Map MakeMap(int num_keyframes) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> near(-2.0, 2.0);
  Map map;
  std::vector<LandmarkId> points, lines;
  for (int i = 0; i < num_keyframes; ++i) {
    const Eigen::Vector3d center(0.2 * i, 0.0, 0.0);
    const KeyframeId keyframe =
        map.AddKeyframe(RandomFrame(&random), {Eigen::Quaterniond::Identity(), -center});
    map.SetStepCovariance(keyframe, IsotropicCovariance(0.001, 0.001));
    const Eigen::Vector3d place = center + Eigen::Vector3d(near(random), near(random), 3.0);
    AddLandmarks<PointLandmark>(keyframe, kNewPoints, place, &points, &map);
    AddLandmarks<LineLandmark>(keyframe, kNewLines,
                               LineSegment3{place, place + Eigen::Vector3d::UnitX()}, &lines, &map);
  }
  return map;
}

void Memory(benchmark::State& state) {
  const int num_keyframes = static_cast<int>(state.range(0));
  double map_size = 0.0, index_size = 0.0;
  for (auto _ : state) {
    const double before = MegabytesInUse();
    MapSnapshot snapshot;
    snapshot.map = MakeMap(num_keyframes);
    const double with_map = MegabytesInUse();
    PlaceIndex index;
    index.Update(snapshot);
    map_size = with_map - before;
    index_size = MegabytesInUse() - with_map;
  }
  state.counters["map_MB"] = map_size;
  state.counters["index_MB"] = index_size;
}

// The time to publish a snapshot, as the mapper does after every keyframe, and to modify the map
// afterwards. Arguments: number of keyframes in the map, and number of points that are modified
// before each snapshot, the newest ones. The previous snapshot is released, as in tracking.
void Snapshot(benchmark::State& state) {
  Map map = MakeMap(static_cast<int>(state.range(0)));
  std::vector<LandmarkId> moved;
  for (const auto& [id, point] : map.points()) moved.push_back(id);
  moved.erase(moved.begin(), moved.end() - state.range(1));
  MapSnapshotPtr newest;
  for (auto _ : state) {
    for (const LandmarkId id : moved) {
      map.SetGeometry<PointLandmark>(id, Eigen::Vector3d(0.0, 0.0, 3.0));
    }
    auto snapshot = std::make_shared<MapSnapshot>();
    snapshot->map = map.Share();
    newest = std::move(snapshot);
  }
  state.counters["points"] = static_cast<double>(map.points().size());
  state.counters["lines"] = static_cast<double>(map.lines().size());
}

void PlaceQuery(benchmark::State& state) {
  MapSnapshot snapshot;
  snapshot.map = MakeMap(static_cast<int>(state.range(0)));
  PlaceIndex index;
  index.Update(snapshot);
  std::mt19937 random(2);
  std::vector<std::shared_ptr<const Frame>> frames;  // several: their words are in no cache
  for (int i = 0; i < 64; ++i) frames.push_back(RandomFrame(&random));
  size_t next = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(index.Query(*frames[next++ % frames.size()], index.size()));
  }
}

// Adds a keyframe and removes the oldest one.
void PlaceReplacement(benchmark::State& state) {
  const KeyframeId num_keyframes = state.range(0);
  std::mt19937 random(1);
  PlaceIndex index;
  KeyframeId next = 0;
  while (next < num_keyframes) index.Add(next++, RandomFrame(&random));
  std::chrono::duration<double, std::milli> longest{};
  for (auto _ : state) {
    state.PauseTiming();
    std::shared_ptr<const Frame> frame = RandomFrame(&random);
    state.ResumeTiming();
    const auto start = std::chrono::steady_clock::now();
    index.Add(next, std::move(frame));
    index.Remove(next - num_keyframes);
    ++next;
    longest = std::max<decltype(longest)>(longest, std::chrono::steady_clock::now() - start);
  }
  state.counters["longest_ms"] = longest.count();
}

// A path around a circle that drifts, links to the three keyframes before each one, and one loop
// where it closes.
PoseGraph MakeGraph(int num_keyframes) {
  std::mt19937 random(1);
  constexpr double kSigma = 0.002;  // metres and radians, of a step
  std::normal_distribution<double> error(0.0, kSigma);
  const double turn = 2.0 * M_PI / num_keyframes, radius = 0.2 / turn;
  const PoseCovariance covariance = IsotropicCovariance(kSigma, kSigma);
  const auto truth = [&](int i) {
    const Eigen::Quaterniond world_from_cam = ExpSO3({0.0, -turn * i, 0.0});
    return Rigid3(world_from_cam, world_from_cam * Eigen::Vector3d(radius, 0.0, 0.0)).Inverse();
  };
  PoseGraph graph;
  graph.poses[0] = truth(0);
  for (int i = 1; i < num_keyframes; ++i) {
    const Rigid3 step = truth(i) * truth(i - 1).Inverse();
    const Eigen::Vector3d angle(error(random), error(random), error(random));
    const Eigen::Vector3d shift(error(random), error(random), error(random));
    graph.poses[i] =
        Rigid3(ExpSO3(angle) * step.rotation(), step.translation() + shift) * graph.poses[i - 1];
    for (int j = std::max(0, i - 3); j < i; ++j) {
      graph.edges.push_back({j, i, graph.poses[i] * graph.poses[j].Inverse(), covariance});
    }
  }
  const int last = num_keyframes - 1;
  graph.edges.push_back({0, last, truth(last) * truth(0).Inverse(), covariance});
  return graph;
}

void OneLoop(benchmark::State& state) {
  const PoseGraph graph = MakeGraph(static_cast<int>(state.range(0)));
  for (auto _ : state) {
    PoseGraph solved = graph;
    if (OptimizePoseGraph(&solved).empty()) state.SkipWithError("not solved");
  }
}

MapContents Share(Map* map) {
  MapContents contents;
  contents.sessions.push_back({0, "growth"});
  SavedSubMap submap;
  submap.map = map->Share();
  contents.submaps.push_back(std::move(submap));
  return contents;
}

void MapFile(benchmark::State& state, bool reads) {
  Map map = MakeMap(static_cast<int>(state.range(0)));
  const std::filesystem::path path =
      std::filesystem::temp_directory_path() / "msc_vo_growth_benchmark.map";
  SaveMap(path, Share(&map));
  for (auto _ : state) {
    if (reads) {
      benchmark::DoNotOptimize(LoadMap(path));
    } else {
      state.PauseTiming();
      std::filesystem::remove(path);
      state.ResumeTiming();
      SaveMap(path, Share(&map));
    }
  }
  state.counters["file_MB"] = static_cast<double>(std::filesystem::file_size(path)) / 1e6;
  std::filesystem::remove(path);
}
void SaveFile(benchmark::State& state) { MapFile(state, false); }
void LoadFile(benchmark::State& state) { MapFile(state, true); }

void Sizes(benchmark::internal::Benchmark* benchmark) {
  benchmark->Arg(100)->Arg(300)->Arg(1000)->Arg(3000)->Arg(10000)->Unit(benchmark::kMillisecond);
}
BENCHMARK(Memory)->Apply(Sizes)->Iterations(1);
BENCHMARK(Snapshot)->ArgsProduct({{15, 60, 240}, {0, 1000}})->Unit(benchmark::kMillisecond);
BENCHMARK(PlaceQuery)->Apply(Sizes);
// With renumbering, which happens once in as many replacements as there are keyframes.
BENCHMARK(PlaceReplacement)->Arg(1000)->Iterations(2000)->Unit(benchmark::kMillisecond);
BENCHMARK(PlaceReplacement)->Arg(10000)->Iterations(20000)->Unit(benchmark::kMillisecond);
BENCHMARK(OneLoop)->Apply(Sizes);
BENCHMARK(SaveFile)->Apply(Sizes);
BENCHMARK(LoadFile)->Apply(Sizes);

}  // namespace

}  // namespace msc_vo

BENCHMARK_MAIN();
