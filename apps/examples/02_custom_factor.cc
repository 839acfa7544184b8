// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// A factor of your own in local bundle adjustment: distances of the camera from three beacons at
// known positions. Their common offset is unknown and a parameter block of your own.

#include <cstdio>
#include <random>

#include "msc_vo/bundle_adjustment/local_bundle_adjustment.h"
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

void AddBeacons(const WindowData& truth, WindowData* window) {
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0.0, 0.001);
  window->extra_blocks.push_back({0, Eigen::VectorXd::Zero(1), nullptr});  // id, initial value
  for (const Eigen::Vector3d& beacon : {Eigen::Vector3d(9, 0, 0), {0, 9, 0}, {0, 0, 9}}) {
    for (const WindowData::Keyframe& keyframe : truth.keyframes) {
      const double range = (keyframe.cam_from_world * beacon).norm() + 0.3 + noise(random);
      window->custom_factors.push_back({"beacon",
                                        BeaconRange::CreateShared(beacon, range, 0.001),
                                        nullptr,  // no robust loss
                                        {BlockId::Pose(keyframe.id), BlockId::Extra(0)}});
    }
  }
}

// Solves the window and returns the error of the last position, millimetres.
double Solve(const WindowData& truth, WindowData* window) {
  msc_vo::LocalBundleAdjustment(msc_vo::BundleAdjustmentOptions(), window);
  return 1000.0 * (window->keyframes.back().cam_from_world.OriginInSource() -
                   truth.keyframes.back().cam_from_world.OriginInSource())
                      .norm();
}

}  // namespace

int main() {
  msc_vo::SyntheticWindowOptions options;
  options.num_points = 40;
  options.num_lines = 0;
  const msc_vo::SyntheticWindow scene = msc_vo::MakeSyntheticWindow(options);
  WindowData without = scene.data, with = scene.data;
  AddBeacons(scene.truth, &with);
  const auto& pose = scene.truth.keyframes[0].cam_from_world.params;
  const msc_vo::Rigid3Manifold manifold;
  const msc_vo::JacobianCheck check = msc_vo::CheckJacobians(
      *with.custom_factors[0].cost, {{pose.begin(), pose.end()}, {0.1}}, {&manifold, nullptr});
  const double error = Solve(scene.truth, &without), error_with = Solve(scene.truth, &with);
  std::printf("position error without beacons %.2f mm, with beacons %.2f mm; offset %.3f m\n",
              error, error_with, with.extra_blocks[0].value[0]);
  return check.deviation < 1e-7 && error_with < 0.5 * error ? 0 : 1;
}
