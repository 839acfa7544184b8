// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// The odometry in random worlds of places that look alike: false loops, and returns that are found.

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
  const LoopScore score = ScoreClaims(world, ClaimsOf(result));
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

int RunWorlds(int argc, char** argv) {
  int num_alike = 20, num_returns = 10;
  LoopWorldOptions options;
  std::string scene;
  CLI::App app("Odometry in random worlds of places that look alike");
  app.add_option("--worlds", num_alike, "Worlds without returns")->capture_default_str();
  app.add_option("--returns", num_returns, "Worlds with returns")->capture_default_str();
  app.add_option("--seed", options.seed, "Seed of the first world")->capture_default_str();
  app.add_option("--path", options.path, "Path through the worlds")->capture_default_str();
  app.add_option("--scene", scene, "Scene of all worlds; default: all four in turn")
      ->check(CLI::IsMember({"rooms", "mirrored", "floors", "desks"}));
  CLI11_PARSE(app, argc, argv);
  std::printf(
      "scene      seed path returns images rendering odometry      APE tracked segments claims "
      "false found/returns\n");
  Totals totals;
  const uint64_t first = options.seed;
  for (const bool returns : {false, true}) {
    for (int i = 0; i < (returns ? num_returns : num_alike); ++i) {
      options.seed = first + static_cast<uint64_t>(i);
      options.returns = returns;
      options.scene = scene.empty() ? LookAlikeKind(i) : *SceneKindFromName(scene);
      RunWorld(options, &totals);
    }
  }
  std::printf("%d worlds: %d claims, %d false loops, %d of %d returns found\n", totals.worlds,
              totals.claims, totals.false_loops, totals.found, totals.returns);
  return totals.false_loops == 0 ? 0 : 1;
}

}  // namespace

}  // namespace msc_vo

int main(int argc, char** argv) { return msc_vo::RunWorlds(argc, argv); }
