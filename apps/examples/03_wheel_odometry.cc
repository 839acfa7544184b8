// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Wheel odometry in the running odometry. The lens is covered for one second, a wheel slips for a
// third of a second, and the scale of the wheels is an extra block that is estimated on the way.

#include <ceres/loss_function.h>

#include "apps/examples/simulated_camera.h"
#include "msc_vo/factors/relative_pose.h"

namespace {

using msc_vo::BlockId, msc_vo::Rigid3;

class Wheels {
 public:
  // Dead reckoning: steps that are 5 % too short, and twice as long where a wheel slips.
  explicit Wheels(const msc_vo::SimulatedCamera& camera) : camera_(camera), poses_(1) {
    for (int i = 1; i < camera.num_images(); ++i) {
      Rigid3 step = camera.CamFromWorld(i) * camera.CamFromWorld(i - 1).Inverse();
      step.translation() *= (i >= 20 && i < 30 ? 2.0 : 1.0) / 1.05;
      poses_.push_back(step * poses_.back());
    }
  }
  // A factor between every two keyframes that follow each other.
  msc_vo::WindowFactors ForWindow(const msc_vo::WindowContext& window) const {
    msc_vo::WindowFactors result;
    result.extra_blocks.push_back({0, Eigen::VectorXd::Ones(1), nullptr});  // Euclidean
    for (size_t i = 1; i < window.keyframes.size(); ++i) {
      const auto &a = window.keyframes[i - 1], &b = window.keyframes[i];
      const auto cost = msc_vo::ScaledRelativePose::CreateShared(
          Motion(a.timestamp, b.timestamp), Covariance(b.timestamp - a.timestamp));
      result.factors.push_back(
          {"wheels", cost, loss_, {BlockId::Pose(a.id), BlockId::Pose(b.id), BlockId::Extra(0)}});
    }
    return result;
  }
  // The pose of a frame from the last one, with the scale as estimated in the map of the frame.
  // Without an image there is nothing else.
  std::vector<msc_vo::PoseFactor> ForFrame(const msc_vo::FrameContext& frame) const {
    Rigid3 motion = Motion(frame.last_timestamp, frame.timestamp);
    if (!frame.extra_blocks.empty()) motion.translation() *= frame.extra_blocks[0].value[0];
    const auto cost = msc_vo::PosePrior::CreateShared(
        motion * frame.last_cam_from_world, Covariance(frame.timestamp - frame.last_timestamp));
    return {{"wheels", cost, loss_}};
  }

 private:
  Rigid3 Motion(double from, double to) const {
    return poses_[camera_.IndexAt(to)] * poses_[camera_.IndexAt(from)].Inverse();
  }
  // A random walk of 0.3 degrees and 5 mm in a second, for each axis.
  static msc_vo::PosePrior::Matrix6d Covariance(double seconds) {
    return 0.005 * 0.005 * seconds * msc_vo::PosePrior::Matrix6d::Identity();  // radians, metres
  }

  const msc_vo::SimulatedCamera& camera_;
  std::vector<Rigid3> poses_;                                               // cam_from_start
  std::shared_ptr<ceres::LossFunction> loss_{new ceres::CauchyLoss(2.45)};  // sqrt(6) rows
};

}  // namespace

int main() {
  const msc_vo::SimulatedCamera camera(msc_vo::SceneKind::kRoom, 110, 60, 90);
  const msc_vo::OdometryOptions options;  // two threads: the callbacks share nothing that changes
  msc_vo::Odometry vision(options, camera.camera(), {}), both(options, camera.camera(), {});
  const Wheels wheels(camera);
  both.SetWindowFactors([&](const auto& window) { return wheels.ForWindow(window); });
  both.SetPoseFactors([&](const auto& frame) { return wheels.ForFrame(frame); });
  const msc_vo::OdometryResult result = camera.Replay(&both);
  const double with = camera.PositionError(result), scale = result.extra_blocks.at(0).value[0];
  const double without = camera.PositionError(camera.Replay(&vision));
  std::printf("error without wheels %.4f m, with %.4f m; scale %.3f\n", without, with, scale);
  return with < 0.75 * without ? 0 : 1;
}
