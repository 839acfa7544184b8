// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// A factor of your own in local bundle adjustment: distances of the camera from three beacons at
// known positions. Their common offset is unknown and a parameter block of your own. The window is
// solved by LocalBundleAdjustment, and as a Ceres problem to which the same factors are added.

#include <cstdio>
#include <random>
#include <vector>

#include "msc_vo/bundle_adjustment/local_bundle_adjustment.h"
#include "msc_vo/bundle_adjustment/window_problem.h"
#include "msc_vo/factors/cost_functor.h"
#include "msc_vo/factors/jacobian_check.h"
#include "msc_vo/factors/rigid3_manifold.h"
#include "msc_vo/synthetic/window/synthetic_window.h"

namespace {

using msc_vo::BlockId, msc_vo::WindowData;

// r = (|R B + t| + offset - range) / sigma, 1 row. (R, t): cam_from_world (block 0, 7). B: beacon
// in the world. offset: block 1, 1. All in metres.
struct BeaconRange : public msc_vo::CostFunctor<BeaconRange, 1, 7, 1> {
  BeaconRange(const Eigen::Vector3d& b, double r, double s) : beacon(b), range(r), sigma(s) {}

  template <typename T>
  bool operator()(const T* cam_from_world, const T* offset, T* residuals) const {
    const Eigen::Map<const Eigen::Quaternion<T>> q(cam_from_world);
    const Eigen::Map<const Eigen::Matrix<T, 3, 1>> t(cam_from_world + 4);
    residuals[0] = ((q * beacon.cast<T>() + t).norm() + offset[0] - range) / sigma;
    return true;
  }

  Eigen::Vector3d beacon;
  double range, sigma;
};

struct Measurement {
  int64_t keyframe;
  BeaconRange factor;
};

std::vector<Measurement> Measure(const WindowData& truth) {
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0.0, 0.001);
  std::vector<Measurement> measurements;
  for (const Eigen::Vector3d& beacon : {Eigen::Vector3d(9, 0, 0), {0, 9, 0}, {0, 0, 9}}) {
    for (const WindowData::Keyframe& keyframe : truth.keyframes) {
      const double range = (keyframe.cam_from_world * beacon).norm() + 0.3 + noise(random);
      measurements.push_back({keyframe.id, BeaconRange(beacon, range, 0.001)});
    }
  }
  return measurements;
}

void AddBeacons(const std::vector<Measurement>& measurements, WindowData* window) {
  window->extra_blocks.push_back({0, Eigen::VectorXd::Zero(1), nullptr});  // id, initial value
  for (const auto& [keyframe, factor] : measurements) {
    window->custom_factors.push_back({"beacon",
                                      BeaconRange::CreateShared(factor),
                                      nullptr,  // no robust loss
                                      {BlockId::Pose(keyframe), BlockId::Extra(0)}});
  }
}

// Error of the last position, millimetres.
double Error(const WindowData& truth, const WindowData& window) {
  return 1000.0 * (window.keyframes.back().cam_from_world.OriginInSource() -
                   truth.keyframes.back().cam_from_world.OriginInSource())
                      .norm();
}

double Solve(const WindowData& truth, WindowData* window) {
  msc_vo::LocalBundleAdjustment(msc_vo::BundleAdjustmentOptions(), window);
  return Error(truth, *window);
}

// The same by Ceres, with residual blocks over the poses of the window and a parameter of this
// function.
double SolveWithCeres(const WindowData& truth, const std::vector<Measurement>& measurements,
                      WindowData window) {
  msc_vo::WindowProblem problem(msc_vo::BundleAdjustmentOptions(), window);
  double offset = 0.0;
  for (const auto& [keyframe, factor] : measurements) {
    problem.AddResidualBlock(BeaconRange::Create(factor), nullptr,
                             {problem.Block(BlockId::Pose(keyframe)), &offset});
  }
  ceres::Solver::Summary summary;
  ceres::Solve(problem.SolverOptions(20), problem.problem(), &summary);
  problem.WriteBack(&window);
  return Error(truth, window);
}

}  // namespace

int main() {
  msc_vo::SyntheticWindowOptions options;
  options.num_points = 40;
  options.num_lines = 0;
  const msc_vo::SyntheticWindow scene = msc_vo::MakeSyntheticWindow(options);
  WindowData without = scene.data, with = scene.data;
  const std::vector<Measurement> measurements = Measure(scene.truth);
  AddBeacons(measurements, &with);
  const auto& pose = scene.truth.keyframes[0].cam_from_world.params;
  const msc_vo::Rigid3Manifold manifold;
  const msc_vo::JacobianCheck check = msc_vo::CheckJacobians(
      *with.custom_factors[0].cost, {{pose.begin(), pose.end()}, {0.1}}, {&manifold, nullptr});
  const double error_in_ceres = SolveWithCeres(scene.truth, measurements, scene.data);
  const double error = Solve(scene.truth, &without), error_with = Solve(scene.truth, &with);
  std::printf("position error without beacons %.2f mm, with beacons %.2f mm; offset %.3f m\n",
              error, error_with, with.extra_blocks[0].value[0]);
  std::printf("with beacons in a Ceres problem %.2f mm\n", error_in_ceres);
  return check.deviation < 1e-7 && error_with < 0.5 * error && error_in_ceres < 0.5 * error ? 0 : 1;
}
