// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Extraction of the planes of one 640x480 depth image of a furnished room, with the noise of a
// Kinect, and of a room of blank surfaces.

#include <benchmark/benchmark.h>

#include "apps/benchmarks/rendered_images.h"
#include "msc_vo/features/plane_extractor.h"

namespace msc_vo {

namespace {

void Planes(benchmark::State& state, SceneKind scene) {
  SyntheticSequenceOptions options;
  options.scene = scene;
  options.kinect_depth = true;
  const SyntheticSequence sequence(options);
  const cv::Mat depth = RenderImage(sequence, 40).depth;
  PlaneExtractor extractor({}, sequence.camera(), {});
  size_t num_planes = 0;
  for (auto _ : state) num_planes = extractor.Extract(depth).size();
  state.counters["planes"] = static_cast<double>(num_planes);
}
BENCHMARK_CAPTURE(Planes, room, SceneKind::kRoom)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Planes, blank, SceneKind::kBlank)->Unit(benchmark::kMillisecond);

}  // namespace

}  // namespace msc_vo
