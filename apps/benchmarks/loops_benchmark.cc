// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// The odometry in random worlds of places that look alike: false loops, returns that are found, and
// where second sessions find themselves in the map of the first.

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "apps/benchmarks/loop_world.h"
#include "msc_vo/evaluation/trajectory_error.h"
#include "msc_vo/odometry/odometry.h"

namespace msc_vo {

namespace {

// Processor time of the program, seconds.
double ProcessorSeconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

struct Totals {
  int worlds = 0, claims = 0, false_loops = 0, found = 0, returns = 0;
};

double AbsoluteError(const LoopWorld& world, const OdometryResult& result) {
  std::vector<TimedPose> estimate;
  for (const FrameResult& frame : result.frames) {
    if (frame.world != result.map_world) continue;
    estimate.push_back({frame.timestamp, frame.cam_from_world.Inverse()});
  }
  return EvaluateTrajectory(world.TruePoses(), estimate).ape.rmse;
}

int NumTracked(const OdometryResult& result) {
  int count = 0;
  for (const Segment& segment : result.segments) count += segment.num_estimated;
  return count;
}

void RunWorld(const LoopWorldOptions& options, Totals* totals) {
  const LoopWorld world(options);
  Odometry odometry({}, world.sequence().camera(), {});
  PointOrigins origins(world.num_images());
  odometry.SetTrackingObserver(
      [&origins](const TrackedImage& tracked) { origins[tracked.result.id] = OriginsOf(tracked); });
  double rendering = 0.0, tracking = 0.0;
  for (int i = 0; i < world.num_images(); ++i) {
    const double start = ProcessorSeconds();
    const RgbdImage image = world.Render(i);
    const double rendered = ProcessorSeconds();
    odometry.Process(image);
    rendering += rendered - start;
    tracking += ProcessorSeconds() - rendered;
  }
  const double before_finish = ProcessorSeconds();
  const OdometryResult result = odometry.Finish();
  tracking += ProcessorSeconds() - before_finish;
  const LoopScore score = ScoreClaims(world, ClaimsOf(result), origins);
  std::printf("%-9s %5llu %4llu %-7s %6d %9.2f %8.2f %8.4f %7d %8zu %6d %5d %5d/%d\n",
              world.name().c_str(), static_cast<unsigned long long>(options.seed),
              static_cast<unsigned long long>(options.path), options.returns ? "yes" : "no",
              world.num_images(), rendering, tracking, AbsoluteError(world, result),
              NumTracked(result), result.segments.size(), score.num_claims, score.num_false,
              score.num_found, score.num_returns);
  std::fflush(stdout);
  ++totals->worlds;
  totals->claims += score.num_claims;
  totals->false_loops += score.num_false;
  totals->found += score.num_found;
  totals->returns += score.num_returns;
}

// Poses of a second session in the map of the first, by another path through the same world.
struct SessionScore {
  int num_images = 0, num_localized = 0;
  int num_false = 0;     // off by more than half a metre
  int found = -1;        // image with which the maps were joined; -1: none
  double largest = 0.0;  // error of a position, metres
};

SessionScore RunSession(const LoopWorldOptions& options, uint64_t second_path) {
  const LoopWorld first_visit(options);
  Odometry first({}, first_visit.sequence().camera(), {});
  for (int i = 0; i < first_visit.num_images(); ++i) first.Process(first_visit.Render(i));
  LoopWorldOptions second_visit = options;
  second_visit.path = second_path;
  const LoopWorld world(second_visit);
  Odometry second({}, world.sequence().camera(), {});
  second.SetMap(*first.ShareMaps("first"));
  SessionScore score;
  for (int i = 0; i < world.num_images(); ++i) {
    const FrameResult frame = second.Process(world.Render(i));
    if (score.found < 0 && frame.world == 0) score.found = i;
  }
  const OdometryResult result = second.Finish();
  score.num_images = world.num_images();
  const Rigid3 world_from_truth = first_visit.sequence().PoseAt(0).world_from_cam.Inverse();
  for (int i = 0; i < world.num_images(); ++i) {
    const FrameResult& frame = result.frames[i];
    if (frame.world != 0 || !IsEstimated(frame.status)) continue;
    ++score.num_localized;
    const Rigid3 truth = world_from_truth * world.sequence().PoseAt(i).world_from_cam;
    const double error = (truth.translation() - frame.cam_from_world.OriginInSource()).norm();
    score.largest = std::max(score.largest, error);
    if (error > 0.5) ++score.num_false;
  }
  return score;
}

// Returns the number of sessions with false poses.
int RunSessions(int num, uint64_t second_path, const std::string& scene, LoopWorldOptions options) {
  std::printf("scene      seed path returns images localized found false largest error\n");
  int num_false = 0, num_found = 0;
  const uint64_t first = options.seed;
  for (int i = 0; i < num; ++i) {
    options.seed = first + static_cast<uint64_t>(i);
    options.scene = scene.empty() ? LookAlikeKind(i) : *SceneKindFromName(scene);
    options.returns = SupportsReturns(options.scene) && i % 8 >= 4;
    const SessionScore score = RunSession(options, second_path);
    std::printf("%-9s %5llu %4llu %-7s %6d %9d %5d %5d %13.4f\n",
                SceneKindNames()[static_cast<int>(options.scene)].c_str(),
                static_cast<unsigned long long>(options.seed),
                static_cast<unsigned long long>(second_path), options.returns ? "yes" : "no",
                score.num_images, score.num_localized, score.found, score.num_false, score.largest);
    std::fflush(stdout);
    num_false += score.num_false > 0 ? 1 : 0;
    num_found += score.num_localized > 0 ? 1 : 0;
  }
  std::printf("%d sessions: %d found in the map, %d with false poses\n", num, num_found, num_false);
  return num_false;
}

int RunWorlds(int argc, char** argv) {
  int num_alike = 20, num_returns = 10, num_sessions = 0;
  LoopWorldOptions options;
  std::string scene;
  CLI::App app("Odometry in random worlds of places that look alike");
  app.add_option("--worlds", num_alike, "Worlds without returns")->capture_default_str();
  app.add_option("--returns", num_returns, "Worlds with returns")->capture_default_str();
  app.add_option("--sessions", num_sessions, "Worlds that are visited a second time")
      ->capture_default_str();
  uint64_t second_path = 0;
  app.add_option("--session-path", second_path, "Path of the second session; default: --path + 1")
      ->check(CLI::PositiveNumber);
  double min_found = 0.0;
  app.add_option("--min-found", min_found, "Ratio of the returns; exit code 1 if fewer are found")
      ->capture_default_str();
  app.add_option("--seed", options.seed, "Seed of the first world")->capture_default_str();
  app.add_option("--path", options.path, "Path through the worlds")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  app.add_option("--scene", scene, "Scene of all worlds; default: all four in turn")
      ->check(CLI::IsMember({"rooms", "mirrored", "floors", "desks", "gallery"}));
  CLI11_PARSE(app, argc, argv);
  if (second_path == 0) second_path = options.path + 1;
  std::printf(
      "scene      seed path returns images rendering odometry      APE tracked segments claims "
      "false found/returns\n");
  Totals totals;
  const uint64_t first = options.seed;
  for (const bool returns : {false, true}) {
    for (int i = 0; i < (returns ? num_returns : num_alike); ++i) {
      options.seed = first + static_cast<uint64_t>(i);
      options.scene = scene.empty() ? LookAlikeKind(i) : *SceneKindFromName(scene);
      if (returns && !SupportsReturns(options.scene)) continue;
      options.returns = returns;
      RunWorld(options, &totals);
    }
  }
  std::printf("%d worlds: %d claims, %d false loops, %d of %d returns found\n", totals.worlds,
              totals.claims, totals.false_loops, totals.found, totals.returns);
  options.seed = first;
  const int num_false =
      num_sessions > 0 ? RunSessions(num_sessions, second_path, scene, options) : 0;
  const bool found_enough = totals.found >= min_found * totals.returns;
  return found_enough && totals.false_loops + num_false == 0 ? 0 : 1;
}

}  // namespace

}  // namespace msc_vo

int main(int argc, char** argv) {
  try {
    return msc_vo::RunWorlds(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 1;
  }
}
