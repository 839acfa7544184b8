// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/inertial/gravity_factors.h"

#include <cmath>
#include <functional>
#include <stdexcept>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "msc_vo/bundle_adjustment/local_bundle_adjustment.h"
#include "msc_vo/factors/relative_pose.h"
#include "msc_vo/geometry/angles.h"
#include "msc_vo/geometry/so3.h"
#include "msc_vo/synthetic/scene/random.h"
#include "msc_vo/synthetic/scene/synthetic_sequence.h"

namespace msc_vo {
namespace {

constexpr int kKeyframeInterval = 10;  // frames, of 30 per second
constexpr size_t kWindow = 12;         // keyframes, of which the first is fixed
constexpr double kRotationSigma = 0.02 * kPi / 180.0, kTranslationSigma = 0.002;  // of a step

// A sliding window of keyframes along a walk through a house, whose relative poses are measured
// with random errors, so that roll and pitch drift.
class Walk {
 public:
  explicit Walk(int num_frames) : sequence_(Options()), num_frames_(num_frames), random_(5) {}

  std::vector<TimedAcceleration> Readings() const {
    return sequence_.AccelerometerReadings(num_frames_);
  }

  // Estimates the poses of all keyframes. `gravity` may be empty.
  void Run(const WindowFactorCallback& gravity) {
    const TimedPose first = sequence_.PoseAt(0);
    stamps_ = {first.timestamp};
    truth_ = poses_ = {first.world_from_cam.Inverse()};
    for (int i = kKeyframeInterval; i < num_frames_; i += kKeyframeInterval) {
      const TimedPose pose = sequence_.PoseAt(i);
      stamps_.push_back(pose.timestamp);
      truth_.push_back(pose.world_from_cam.Inverse());
      AddStep();
      Optimize(gravity);
    }
  }

  // Root mean square of the angle between the estimated and the true vertical in a camera, degrees.
  // The world of the estimate is that of the truth, so that its vertical is the z axis.
  double TiltError() const {
    double squares = 0.0;
    for (size_t i = 0; i < poses_.size(); ++i) {
      const Eigen::Vector3d up = poses_[i].rotation() * Eigen::Vector3d::UnitZ();
      const Eigen::Vector3d truth = truth_[i].rotation() * Eigen::Vector3d::UnitZ();
      squares += up.cross(truth).squaredNorm();
    }
    return std::sqrt(squares / static_cast<double>(poses_.size())) * 180.0 / kPi;
  }
  const std::vector<ExtraBlock>& extra_blocks() const { return extra_blocks_; }

 private:
  static SyntheticSequenceOptions Options() {
    SyntheticSequenceOptions options;
    options.scene = SceneKind::kHouse;
    options.width = options.height = 32;
    return options;
  }
  static PosePrior::Matrix6d StepCovariance() {
    PosePrior::Matrix6d covariance = PosePrior::Matrix6d::Identity();
    covariance.topLeftCorner<3, 3>() *= kRotationSigma * kRotationSigma;
    covariance.bottomRightCorner<3, 3>() *= kTranslationSigma * kTranslationSigma;
    return covariance;
  }

  // Measures the step to the newest keyframe and predicts its pose.
  void AddStep() {
    const Rigid3 step = truth_.back() * truth_[truth_.size() - 2].Inverse();
    const Rigid3 error(ExpSO3(kRotationSigma * random_.Normal3()),
                       kTranslationSigma * random_.Normal3());
    steps_.push_back(error * step);
    poses_.push_back(steps_.back() * poses_.back());
  }

  void Optimize(const WindowFactorCallback& gravity) {
    const size_t begin = poses_.size() > kWindow ? poses_.size() - kWindow : 0;
    WindowData window;
    WindowContext context;
    context.extra_blocks = extra_blocks_;
    for (size_t i = begin; i < poses_.size(); ++i) {
      const auto id = static_cast<int64_t>(i);
      window.keyframes.push_back({id, poses_[i], i == begin});
      context.keyframes.push_back({id, stamps_[i], poses_[i], i == begin});
      if (i == begin) continue;
      window.custom_factors.push_back({"step",
                                       RelativePose::CreateShared(steps_[i - 1], StepCovariance()),
                                       nullptr,
                                       {BlockId::Pose(id - 1), BlockId::Pose(id)}});
    }
    if (gravity) AddFactors(gravity(context), &window);
    const BundleAdjustmentSummary summary =
        LocalBundleAdjustment(BundleAdjustmentOptions(), &window);
    ASSERT_TRUE(summary.usable) << summary.message;
    for (const WindowData::Keyframe& keyframe : window.keyframes) {
      poses_[static_cast<size_t>(keyframe.id)] = keyframe.cam_from_world;
    }
    if (!window.extra_blocks.empty()) extra_blocks_ = window.extra_blocks;
  }
  // Blocks that were used before keep their estimated values, as in Mapper.
  void AddFactors(const WindowFactors& factors, WindowData* window) const {
    window->extra_blocks = factors.extra_blocks;
    for (size_t i = 0; i < extra_blocks_.size(); ++i) {
      window->extra_blocks.at(i).value = extra_blocks_[i].value;
    }
    window->custom_factors.insert(window->custom_factors.end(), factors.factors.begin(),
                                  factors.factors.end());
  }

  SyntheticSequence sequence_;
  int num_frames_;
  Random random_;
  std::vector<double> stamps_;
  std::vector<Rigid3> truth_, poses_;  // cam_from_world
  std::vector<Rigid3> steps_;
  std::vector<ExtraBlock> extra_blocks_;
};

TEST(GravityFactors, HoldRollAndPitchOfALongWalk) {
  constexpr int kFrames = 3000;
  Walk without(kFrames), with(kFrames);
  without.Run({});
  with.Run(GravityFactors(with.Readings(), GravityOptions()));
  EXPECT_LT(with.TiltError(), 0.1);
  EXPECT_LT(with.TiltError(), 0.5 * without.TiltError());
  ASSERT_EQ(with.extra_blocks().size(), 1u);
  EXPECT_NEAR(with.extra_blocks()[0].value.z(), 1.0, 1e-5);
}

TEST(GravityFactors, AreNoneBeforeTheVerticalIsMeasured) {
  GravityFactors gravity(Walk(300).Readings(), GravityOptions());
  WindowContext window;
  window.keyframes.push_back({0, 1.0, Rigid3(), true});
  window.keyframes.push_back({1, 1.5, Rigid3(), false});
  const WindowFactors factors = gravity(window);
  EXPECT_TRUE(factors.factors.empty());
  EXPECT_TRUE(factors.extra_blocks.empty());
  EXPECT_FALSE(gravity.HasMeasured());
}

TEST(GravityFactors, SayWhetherTheVerticalWasMeasured) {
  for (const double offset : {0.0, 1000.0}) {
    Walk walk(300);
    std::vector<TimedAcceleration> readings = walk.Readings();
    for (TimedAcceleration& reading : readings) reading.timestamp += offset;
    GravityFactors gravity(std::move(readings), GravityOptions());
    EXPECT_FALSE(gravity.HasMeasured());
    walk.Run(std::ref(gravity));
    EXPECT_EQ(gravity.HasMeasured(), offset == 0.0);
  }
}

// The vertical of one world says nothing about another one.
TEST(GravityFactors, EstimateAVerticalInEveryWorld) {
  const Eigen::Vector3d up_in_cam = Eigen::Vector3d(0.1, -1.0, 0.2).normalized();
  std::vector<TimedAcceleration> readings;
  for (int i = 0; i < 600; ++i) readings.push_back({0.01 * i, 9.81 * up_in_cam});
  GravityFactors gravity(readings, GravityOptions());
  const Rigid3 cam_from_world[] = {Rigid3(), Rigid3(ExpSO3({0.4, 0.2, -0.3}), {1.0, 0.0, 0.0})};
  for (const int world : {0, 1, 0}) {
    WindowContext window;
    window.world = world;
    for (int i = 1; i < 5; ++i) {
      window.keyframes.push_back({10 * world + i, 1.0 * i, cam_from_world[world], false});
    }
    const WindowFactors factors = gravity(window);
    ASSERT_EQ(factors.extra_blocks.size(), 1u);
    EXPECT_EQ(factors.extra_blocks[0].id, world);
    const Eigen::Vector3d up = cam_from_world[world].rotation().conjugate() * up_in_cam;
    EXPECT_LT((factors.extra_blocks[0].value - up).norm(), 1e-6) << world;
  }
}

TEST(GravityFactors, RejectInvalidOptions) {
  GravityOptions options;
  options.min_sigma = 0.0;
  EXPECT_THROW(GravityFactors({}, options), std::invalid_argument);
}

}  // namespace
}  // namespace msc_vo
