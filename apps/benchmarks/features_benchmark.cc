// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// The stages of feature extraction from one 640x480 image. "allocations" are the calls of operator
// new per image in steady state (without the memory of OpenCV).

#include <benchmark/benchmark.h>

#include "apps/benchmarks/allocation_counter.h"
#include "apps/benchmarks/rendered_images.h"
#include "msc_vo/features/frame_builder.h"
#include "msc_vo/features/internal/edge_segments.h"
#include "msc_vo/features/internal/line_descriptor_extractor.h"
#include "msc_vo/features/surface_normals.h"

namespace msc_vo {

namespace {

struct ImageInput {
  SyntheticSequence sequence = BenchmarkSequence();
  RgbdImage image = RenderImage(sequence, 40);
};

const ImageInput& SharedImage() {
  static const ImageInput input;
  return input;
}

// Measures `step`, which returns its number of features.
template <typename Step>
void Measure(benchmark::State& state, const Step& step) {
  size_t num_features = step(SharedImage().image);  // grows the buffers
  const int64_t before = NumAllocations();
  for (auto _ : state) num_features = step(SharedImage().image);
  state.counters["allocations"] = benchmark::Counter(static_cast<double>(NumAllocations() - before),
                                                     benchmark::Counter::kAvgIterations);
  state.counters["features"] = static_cast<double>(num_features);
}

void Points(benchmark::State& state) {
  PointExtractor extractor({});
  Measure(state, [&](const RgbdImage& image) { return extractor.Extract(image.gray).size(); });
}
BENCHMARK(Points)->Unit(benchmark::kMillisecond);

void EdgeSegments(benchmark::State& state) {
  EdgeSegmentDetector detector;
  Measure(state, [&](const RgbdImage& image) { return detector.Detect(image.gray).size(); });
}
BENCHMARK(EdgeSegments)->Unit(benchmark::kMillisecond);

void Lines(benchmark::State& state, LineDetector detector) {
  LineExtractorOptions options;
  options.detector = detector;
  LineExtractor extractor(options);
  Measure(state, [&](const RgbdImage& image) { return extractor.Extract(image.gray).size(); });
}
BENCHMARK_CAPTURE(Lines, edge_drawing, LineDetector::kEdgeDrawing)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Lines, lsd, LineDetector::kLsd)->Unit(benchmark::kMillisecond);

void LineDescriptors(benchmark::State& state) {
  const auto lines = LineExtractor({}).Extract(SharedImage().image.gray);
  LineDescriptorExtractor descriptor_extractor;
  Measure(state, [&](const RgbdImage& image) {
    descriptor_extractor.SetImage(image.gray);
    for (const LineFeature& line : lines) {
      benchmark::DoNotOptimize(descriptor_extractor.Describe(line.segment));
    }
    return lines.size();
  });
}
BENCHMARK(LineDescriptors)->Unit(benchmark::kMillisecond);

void WholeFrame(benchmark::State& state) {
  FrameBuilder builder({}, SharedImage().sequence.camera(), LensDistortion());
  Measure(state, [&](const RgbdImage& image) {
    const Frame frame = builder.Build(image);
    return frame.points.size() + frame.lines.size();
  });
}
BENCHMARK(WholeFrame)->Unit(benchmark::kMillisecond);

void SurfaceNormals(benchmark::State& state) {
  SurfaceNormalEstimator estimator({}, SharedImage().sequence.camera(), LensDistortion());
  Measure(state, [&](const RgbdImage& image) { return estimator.Estimate(image.depth).size(); });
}
BENCHMARK(SurfaceNormals)->Unit(benchmark::kMillisecond);

}  // namespace

}  // namespace msc_vo
