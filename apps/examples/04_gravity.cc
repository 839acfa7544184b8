// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Roll and pitch from an accelerometer in the running odometry: GravityFactors adds the factors and
// the direction of the vertical as an extra block.

#include <cmath>
#include <functional>

#include "apps/examples/simulated_camera.h"
#include "msc_vo/inertial/gravity_factors.h"

namespace {

constexpr double kDegreesPerRadian = 57.29577951308232;

// Root mean square of the angle between the vertical in the camera as estimated and as it is,
// degrees. `up`: vertical in the world of the odometry.
double TiltError(const msc_vo::SimulatedCamera& camera, const msc_vo::OdometryResult& result,
                 const Eigen::Vector3d& up) {
  double squares = 0.0;
  for (const msc_vo::FrameResult& frame : result.frames) {
    const Eigen::Vector3d truth = camera.UpInCamera(static_cast<int>(frame.id));
    squares += std::pow((frame.cam_from_world.rotation() * up).cross(truth).norm(), 2);
  }
  return kDegreesPerRadian * std::sqrt(squares / static_cast<double>(result.frames.size()));
}

}  // namespace

int main() {
  const msc_vo::SimulatedCamera camera(msc_vo::SceneKind::kRoom, 300);
  msc_vo::OdometryOptions options;
  options.features.points.num_points = 100;  // few, as on plain walls
  options.mode = msc_vo::Mode::kPlVo;  // without Manhattan axes, which hold roll and pitch too
  msc_vo::Odometry vision(options, camera.camera(), {}), both(options, camera.camera(), {});
  msc_vo::GravityFactors gravity(camera.AccelerometerReadings(), msc_vo::GravityOptions());
  both.SetWindowFactors(std::ref(gravity));
  const msc_vo::OdometryResult result = camera.Replay(&both);
  const Eigen::Vector3d up = result.extra_blocks.at(0).value;
  // Without an accelerometer the vertical of the first image has to be known.
  const double without = TiltError(camera, camera.Replay(&vision), camera.UpInCamera(0));
  const double with = TiltError(camera, result, up);
  std::printf("roll and pitch error without gravity %.3f deg, with gravity %.3f deg\n", without,
              with);
  return with < 0.7 * without ? 0 : 1;
}
