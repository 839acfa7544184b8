// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// One evaluation of each factor with all derivatives: automatic differentiation, which defines the
// factor, and the analytic derivatives that the solvers use.

#include <memory>
#include <vector>

#include <benchmark/benchmark.h>

#include "msc_vo/bundle_adjustment/observation.h"
#include "msc_vo/factors/analytic_cost_function.h"
#include "msc_vo/factors/analytic_line_pair_cost_function.h"
#include "msc_vo/factors/depth_reprojection.h"
#include "msc_vo/factors/line_depth_reprojection.h"
#include "msc_vo/factors/line_endpoint_prior.h"
#include "msc_vo/factors/line_reprojection.h"
#include "msc_vo/factors/manhattan_axis_alignment.h"
#include "msc_vo/factors/parallel_lines.h"
#include "msc_vo/factors/perpendicular_lines.h"
#include "msc_vo/factors/point_reprojection.h"
#include "msc_vo/synthetic/window/synthetic_window.h"

namespace msc_vo {

namespace {

using Blocks = std::vector<std::vector<double>>;

std::vector<double> Block(const Rigid3& pose) {
  return {pose.params.data(), pose.params.data() + 7};
}
std::vector<double> Block(const Eigen::Vector3d& x) { return {x.data(), x.data() + 3}; }
std::vector<double> Block(const LineSegment3& line) {
  return {line.start.data(), line.start.data() + 6};
}

// The first observations of a point and of a line in a synthetic window.
struct Input {
  SyntheticWindow window = MakeSyntheticWindow({});
  const WindowData& data = window.data;
  const WindowData::PointObservation& point_observation = data.point_observations.front();
  const WindowData::LineObservation& line_observation = data.line_observations.front();
  Rigid3 pose = data.keyframes.front().cam_from_world;
  LineSegment3 line = data.lines.front().segment, other = data.lines.back().segment;
  LineSegment3 in_cam = pose * line;
  Blocks pose_and_point{Block(pose), Block(data.points.front().position)};
  Blocks pose_and_line{Block(pose), Block(line)};
};

const Input& SharedInput() {
  static const Input input;
  return input;
}

void Evaluate(benchmark::State& state, std::unique_ptr<ceres::CostFunction> cost,
              const Blocks& blocks) {
  std::vector<const double*> parameters;
  std::vector<std::vector<double>> jacobians;
  std::vector<double*> pointers;
  for (const auto& block : blocks) {
    parameters.push_back(block.data());
    jacobians.emplace_back(cost->num_residuals() * block.size());
  }
  for (auto& jacobian : jacobians) pointers.push_back(jacobian.data());
  std::vector<double> residuals(cost->num_residuals());
  for (auto _ : state) {
    if (!cost->Evaluate(parameters.data(), residuals.data(), pointers.data())) {
      state.SkipWithError("the factor is not defined here");
      break;
    }
    benchmark::ClobberMemory();
  }
}

// Registers the automatic form of a factor; RegisterBoth() also registers the analytic form.
template <typename Factor>
void Register(const std::string& name, const Factor& factor, const Blocks& blocks) {
  benchmark::RegisterBenchmark((name + "/automatic").c_str(), [=](benchmark::State& state) {
    Evaluate(state, std::unique_ptr<ceres::CostFunction>(Factor::Create(factor)), blocks);
  });
}
template <typename Analytic, typename Factor>
void RegisterBoth(const std::string& name, const Factor& factor, const Blocks& blocks) {
  Register(name, factor, blocks);
  benchmark::RegisterBenchmark((name + "/analytic").c_str(), [=](benchmark::State& state) {
    Evaluate(state, std::make_unique<Analytic>(factor), blocks);
  });
}

void RegisterAll() {
  const Input& in = SharedInput();
  const PinholeCamera& camera = in.data.camera;
  RegisterBoth<AnalyticCostFunction<PointReprojection>>(
      "PointReprojection",
      PointReprojection(camera, in.point_observation.pixel, in.point_observation.sigma),
      in.pose_and_point);
  RegisterBoth<AnalyticCostFunction<DepthReprojection>>(
      "DepthReprojection",
      DepthReprojection(in.point_observation.inverse_depth,
                        in.point_observation.inverse_depth_sigma),
      in.pose_and_point);
  RegisterBoth<AnalyticCostFunction<LineReprojection>>(
      "LineReprojection",
      MakeLineReprojection(camera, in.line_observation.segment, in.line_observation.sigma,
                           in.in_cam),
      in.pose_and_line);
  RegisterBoth<AnalyticCostFunction<LineDepthReprojection>>(
      "LineDepthReprojection",
      MakeLineDepthReprojection(camera, in.line_observation.segment, in.line_observation.depth,
                                in.in_cam),
      in.pose_and_line);
  const Blocks two_lines{Block(in.line), Block(in.other)};
  RegisterBoth<AnalyticLinePairCostFunction<ParallelLines>>("ParallelLines", ParallelLines(0.01),
                                                            two_lines);
  RegisterBoth<AnalyticLinePairCostFunction<PerpendicularLines>>(
      "PerpendicularLines", PerpendicularLines(0.01), two_lines);
  Register("LineEndpointPrior", LineEndpointPrior(in.line, 0.05), {Block(in.line)});
  Register("ManhattanAxisAlignment", ManhattanAxisAlignment(Eigen::Vector3d::UnitX(), 0.01),
           {Block(in.line)});
}

}  // namespace

}  // namespace msc_vo

int main(int argc, char** argv) {
  msc_vo::RegisterAll();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
