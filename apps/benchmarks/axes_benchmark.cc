// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Manhattan axes: coarse estimation from the lines and normals of one image, and refinement over
// the lines of many keyframes.

#include <benchmark/benchmark.h>

#include "apps/benchmarks/rendered_images.h"
#include "msc_vo/features/frame_builder.h"
#include "msc_vo/features/surface_normals.h"
#include "msc_vo/geometry/so3.h"
#include "msc_vo/structure/axes_refinement.h"
#include "msc_vo/structure/coarse_axes.h"
#include "msc_vo/synthetic/scene/random.h"

namespace msc_vo {

namespace {

void CoarseAxes(benchmark::State& state) {
  const SyntheticSequence sequence = BenchmarkSequence();
  const RgbdImage image = RenderImage(sequence, 40);
  const Frame frame = FrameBuilder({}, sequence.camera(), LensDistortion()).Build(image);
  std::vector<AxisEvidence> lines, normals;
  for (size_t i = 0; i < frame.lines.size(); ++i) {
    const LineFeature& line = frame.lines[i];
    if (!line.depth) continue;
    lines.push_back({frame.LineInCamera(static_cast<int>(i)).Direction(),
                     DirectionSigma(frame.camera, line.segment, *line.depth)});
  }
  SurfaceNormalEstimator estimator({}, sequence.camera(), LensDistortion());
  for (const auto& normal : estimator.Estimate(image.depth)) {
    normals.push_back({normal.direction, normal.sigma});
  }
  bool found = false;
  for (auto _ : state) found = FindCoarseAxes(lines, normals).has_value();
  state.counters["found"] = found;
  state.counters["lines"] = static_cast<double>(lines.size());
  state.counters["normals"] = static_cast<double>(normals.size());
}
BENCHMARK(CoarseAxes)->Unit(benchmark::kMillisecond);

// The argument is the number of observed lines, every twentieth of which is an outlier. The initial
// axes have an error of one degree.
void RefineAxes(benchmark::State& state) {
  Random random(1, 1);
  constexpr double kSigma = 0.02, kNormalSigma = 0.002;  // radians
  const Eigen::Quaterniond truth = ExpSO3(Eigen::Vector3d(0.3, -0.2, 0.5));
  ManhattanAxesData data;
  data.world_from_manhattan = ExpSO3(Eigen::Vector3d(0.01, 0.01, -0.01)) * truth;
  for (int i = 0; i < state.range(0); ++i) {
    ManhattanAxesData::Observation observation;
    observation.axis = i % 3;
    const Eigen::Vector3d axis =
        i % 20 == 0 ? random.Normal3().normalized() : truth * Eigen::Vector3d::Unit(i % 3);
    observation.normal = axis.cross(random.Normal3()).normalized();
    const Eigen::Vector3d in_plane = observation.normal.cross(axis);
    observation.direction = (axis + kSigma * random.Normal() * in_plane +
                             kNormalSigma * random.Normal() * observation.normal)
                                .normalized();
    observation.normal = in_plane.cross(observation.direction).normalized() * -1.0;
    observation.sigma = kSigma;
    observation.normal_sigma = kNormalSigma;
    data.observations.push_back(observation);
  }
  ManhattanAxesSummary summary;
  for (auto _ : state) {
    ManhattanAxesData copy = data;
    summary = RefineManhattanAxes(&copy);
  }
  state.counters["inliers"] = summary.num_inliers;
}
BENCHMARK(RefineAxes)->Arg(100)->Arg(500)->Arg(2000)->Unit(benchmark::kMillisecond);

}  // namespace

}  // namespace msc_vo
