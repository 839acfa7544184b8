// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// From the features of a frame to its pose, relative to the previous frame and with an empty map.

#include <memory>

#include <benchmark/benchmark.h>

#include "apps/benchmarks/rendered_images.h"
#include "msc_vo/features/frame_builder.h"
#include "msc_vo/tracking/frame_pose.h"

namespace msc_vo {

namespace {

struct FrameInput {
  FrameInput() {
    const SyntheticSequence sequence = BenchmarkSequence();
    FrameBuilder builder({}, sequence.camera(), LensDistortion());
    last.frame = std::make_shared<Frame>(builder.Build(RenderImage(sequence, 40)));
    frame = builder.Build(RenderImage(sequence, 41));
    candidates = CandidatesFromFrame(Map(), last, Rigid3());
    matches = MatchLocalMap(options, frame, candidates, options.prediction_radius, {});
  }

  TrackerOptions options;
  LastFrame last;  // at the origin
  Frame frame;
  LocalMap candidates;  // features of `last`
  FrameMatches matches;
};

const FrameInput& SharedFrame() {
  static const FrameInput input;
  return input;
}

void Candidates(benchmark::State& state) {
  const FrameInput& input = SharedFrame();
  const Map map;
  for (auto _ : state) {
    benchmark::DoNotOptimize(CandidatesFromFrame(map, input.last, Rigid3()));
  }
  state.counters["points"] = static_cast<double>(input.candidates.points.size());
  state.counters["lines"] = static_cast<double>(input.candidates.lines.size());
}
BENCHMARK(Candidates)->Unit(benchmark::kMicrosecond);

// The argument is the search radius, pixels.
void PointMatching(benchmark::State& state) {
  const FrameInput& input = SharedFrame();
  size_t num_matches = 0;
  for (auto _ : state) {
    num_matches = MatchPoints(input.options.matchers.point_matcher, input.frame,
                              input.candidates.points, static_cast<double>(state.range(0)), {})
                      .size();
  }
  state.counters["matches"] = static_cast<double>(num_matches);
}
BENCHMARK(PointMatching)->Arg(4)->Arg(15)->Arg(60)->Unit(benchmark::kMicrosecond);

void LineMatching(benchmark::State& state) {
  const FrameInput& input = SharedFrame();
  size_t num_matches = 0;
  for (auto _ : state) {
    num_matches = MatchLines(input.options.matchers.line_matcher, input.frame,
                             input.candidates.lines, static_cast<double>(state.range(0)), {})
                      .size();
  }
  state.counters["matches"] = static_cast<double>(num_matches);
}
BENCHMARK(LineMatching)->Arg(4)->Arg(15)->Arg(60)->Unit(benchmark::kMicrosecond);

void EstimatePose(benchmark::State& state) {
  const FrameInput& input = SharedFrame();
  PoseSummary summary;
  for (auto _ : state) {
    Rigid3 cam_from_world;
    FrameMatches matches = input.matches;
    summary = EstimateFramePose(input.options.pose, input.frame, Map(), {}, {}, &cam_from_world,
                                &matches);
  }
  state.counters["inlier_points"] = summary.num_inliers.points;
  state.counters["inlier_lines"] = summary.num_inliers.lines;
}
BENCHMARK(EstimatePose)->Unit(benchmark::kMicrosecond);

}  // namespace

}  // namespace msc_vo
