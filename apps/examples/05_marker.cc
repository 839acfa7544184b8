// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// A known marker as absolute pose prior in the running odometry. The marker is in view for the last
// two seconds; its detector measures the pose of the camera in the world with errors of 2 mm and
// 0.1 degrees.

#include <random>

#include "apps/examples/simulated_camera.h"
#include "msc_vo/factors/pose_prior.h"

namespace {

// Takes the place of a detector of markers.
class MarkerDetector {
 public:
  explicit MarkerDetector(const msc_vo::SimulatedCamera& camera) : camera_(camera) {}

  // A prior on every keyframe that observes the marker, whose place is known in the first world.
  msc_vo::WindowFactors operator()(const msc_vo::WindowContext& window) const {
    msc_vo::WindowFactors result;
    if (window.world != 0) return result;
    for (const auto& keyframe : window.keyframes) {
      const int image = camera_.IndexAt(keyframe.timestamp);
      if (image < camera_.num_images() - 60) continue;
      const auto cost = msc_vo::PosePrior::CreateShared(Measure(image), Covariance());
      result.factors.push_back(
          {"marker", cost, /*loss=*/nullptr, {msc_vo::BlockId::Pose(keyframe.id)}});
    }
    return result;
  }

 private:
  static msc_vo::PosePrior::Matrix6d Covariance() {
    msc_vo::PosePrior::Matrix6d covariance = msc_vo::PosePrior::Matrix6d::Identity();
    covariance.topLeftCorner<3, 3>() *= kRotationSigma * kRotationSigma;
    covariance.bottomRightCorner<3, 3>() *= kTranslationSigma * kTranslationSigma;
    return covariance;
  }
  // The same measurement whenever it is asked for.
  msc_vo::Rigid3 Measure(int image) const {
    std::mt19937 random(static_cast<unsigned>(image));
    std::normal_distribution<double> normal;
    const auto noise = [&]() -> Eigen::Vector3d {
      return {normal(random), normal(random), normal(random)};
    };
    const msc_vo::Rigid3 truth = camera_.CamFromWorld(image);
    return {msc_vo::ExpSO3(kRotationSigma * noise()) * truth.rotation(),
            truth.translation() + kTranslationSigma * noise()};
  }

  static constexpr double kRotationSigma = 0.0017, kTranslationSigma = 0.002;  // radians, metres
  const msc_vo::SimulatedCamera& camera_;
};

}  // namespace

int main() {
  const msc_vo::SimulatedCamera camera(msc_vo::SceneKind::kCorridor, 240);
  const msc_vo::OdometryOptions options;
  msc_vo::Odometry vision(options, camera.camera(), {}), both(options, camera.camera(), {});
  both.SetWindowFactors(MarkerDetector(camera));
  const double without = camera.PositionError(camera.Replay(&vision));
  const double with = camera.PositionError(camera.Replay(&both));
  std::printf("position error without marker %.1f mm, with marker %.1f mm\n", 1000.0 * without,
              1000.0 * with);
  return with < 0.8 * without ? 0 : 1;
}
