// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Registration of one 640x480 depth image to colour images of several sizes and lenses.

#include <benchmark/benchmark.h>

#include "apps/benchmarks/rendered_images.h"
#include "msc_vo/sensor/depth_registration.h"

namespace msc_vo {

namespace {

// Colour cameras with the field of view of a phone or of a depth camera's colour sensor.
const PinholeCamera kVga{600.0, 600.0, 319.5, 239.5, 640, 480};
const PinholeCamera kHd{910.0, 910.0, 639.5, 359.5, 1280, 720};

DepthCamera BesideColor(const PinholeCamera& camera) {
  DepthCamera depth_camera;
  depth_camera.camera = camera;
  depth_camera.depth_from_color =
      Rigid3(Eigen::Quaterniond(Eigen::AngleAxisd(0.01, Eigen::Vector3d::UnitZ())),
             Eigen::Vector3d(0.025, 0.001, 0.002));
  return depth_camera;
}

void Registration(benchmark::State& state, const PinholeCamera& color, double k1) {
  static const SyntheticSequence sequence = BenchmarkSequence();
  static const cv::Mat depth = RenderImage(sequence, 40).depth;
  LensDistortion lens;
  lens.k[0] = k1;
  const DepthRegistration registration(BesideColor(sequence.camera()), color, lens);
  for (auto _ : state) benchmark::DoNotOptimize(registration.Register(depth));
}
BENCHMARK_CAPTURE(Registration, to_640x480, kVga, 0.0)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Registration, to_640x480_lens, kVga, 0.1)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Registration, to_1280x720, kHd, 0.0)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Registration, to_1280x720_lens, kHd, 0.1)->Unit(benchmark::kMillisecond);

}  // namespace

}  // namespace msc_vo
